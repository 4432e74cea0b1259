#include "core/quality/worst_elements.h"

#include <algorithm>
#include <cmath>

namespace winslow {

namespace {

/// The larger, the worse.
double badness(const FieldInfo& field, double value) {
  if (field.one_is_best) return std::abs(std::log(value));
  return field.larger_is_better ? -value : value;
}

}  // namespace

Vec3 element_centre(const Mesh& mesh, Index element) {
  Vec3 sum(0, 0, 0);
  const auto nodes = mesh.topology->element(element);
  const bool plane = mesh.coordinates.dimension() == 2;
  for (const Index node : nodes) {
    if (plane) {
      sum.head<2>() += mesh.coordinates.xy(node);
    } else {
      sum += mesh.coordinates.xyz(node);
    }
  }
  return sum / static_cast<double>(nodes.size());
}

std::vector<WorstElement> worst_elements(const Mesh& mesh, std::span<const double> values,
                                         const FieldInfo& field, int count) {
  std::vector<Index> order;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isnan(values[i])) order.push_back(static_cast<Index>(i));
  const auto n = std::min(order.size(), static_cast<std::size_t>(std::max(0, count)));
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end(),
                    [&](Index a, Index b) {
                      const double bad_a = badness(field, values[at(a)]);
                      const double bad_b = badness(field, values[at(b)]);
                      return bad_a != bad_b ? bad_a > bad_b : a < b;
                    });
  std::vector<WorstElement> worst;
  for (const Index e : std::span(order).first(n))
    worst.push_back({e, values[at(e)], element_centre(mesh, e)});
  return worst;
}

}  // namespace winslow
