#include <algorithm>
#include <cmath>
#include <limits>

#include "core/formulation/variational_winslow.h"

/// The regularised determinants of VariationalWinslow: how large they are chosen.
namespace winslow {

namespace {

double determinant(const std::array<Index, 3>& nodes, const Coordinates& x) {
  const Vec2 u = x.xy(nodes[1]) - x.xy(nodes[0]);
  const Vec2 v = x.xy(nodes[2]) - x.xy(nodes[0]);
  return u.x() * v.y() - u.y() * v.x();
}

}  // namespace

/// Mean |determinant| of the triangles around each triangle's nodes.
std::vector<double> VariationalWinslow::cell_sizes(const Coordinates& x) const {
  const auto& triangles = shapes().triangles;
  std::vector<double> sum(static_cast<std::size_t>(topology().node_count()), 0.0);
  std::vector<int> count(sum.size(), 0);
  for (const auto& nodes : triangles) {
    const double size = std::abs(determinant(nodes, x));
    for (const Index node : nodes) {
      sum[static_cast<std::size_t>(node)] += size;
      ++count[static_cast<std::size_t>(node)];
    }
  }
  std::vector<double> sizes;
  sizes.reserve(triangles.size());
  for (const auto& nodes : triangles) {
    double size = 0;
    for (const Index node : nodes) {
      size += sum[static_cast<std::size_t>(node)] / count[static_cast<std::size_t>(node)];
    }
    sizes.push_back(std::max(size / 3, std::numeric_limits<double>::min()));
  }
  return sizes;
}

Regularisation VariationalWinslow::regularisation(const Coordinates& x,
                                                  std::span<const double> sizes,
                                                  double softness) const {
  const auto& triangles = shapes().triangles;
  Regularisation out;
  out.size.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const double negative = std::min(0.0, determinant(triangles[t], x));
    out.size[t] = std::hypot(softness * sizes[t], negative);
  }
  return out;
}

Regularisation VariationalWinslow::full_regularisation(const Coordinates& x) const {
  constexpr double far_beyond = 1e6;  // the largest determinant
  const auto& triangles = shapes().triangles;
  double largest = std::numeric_limits<double>::min();
  for (const auto& nodes : triangles) largest = std::max(largest, std::abs(determinant(nodes, x)));
  return {std::vector<double>(triangles.size(), far_beyond * largest)};
}

}  // namespace winslow
