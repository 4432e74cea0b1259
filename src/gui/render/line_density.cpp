#include "gui/render/line_density.h"

#include <bit>

#include "gui/render/draw_list.h"

namespace winslow::gui {
namespace {

constexpr std::size_t class_count = 2048;

/// Exponent and the first three bits of the fraction: grows with the value.
std::size_t spacing_class(float spacing) {
  return (std::bit_cast<std::uint32_t>(std::max(spacing, 0.0f)) >> 20U) & (class_count - 1);
}

/// The smallest spacing of the class of one: lines_spaced() is exact for those.
float class_floor(float spacing) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(spacing) & ~((1U << 20U) - 1U));
}

}  // namespace

double edge_spacing(const Topology& topology, const Coordinates& coordinates,
                    const Topology::Edge& edge) {
  const double length = (coordinates.xy(edge.nodes[1]) - coordinates.xy(edge.nodes[0])).norm();
  if (!(length > 0)) return 0;
  double spacing = std::numeric_limits<double>::infinity();
  for (const Index e : edge.elements) {
    if (e < 0) continue;
    const auto corners = topology.element(e);
    const Vec2 a = coordinates.xy(corners[0]);
    double area = std::abs(twice_area(a, coordinates.xy(corners[1]), coordinates.xy(corners[2])));
    if (corners.size() == 4) {
      area += std::abs(twice_area(a, coordinates.xy(corners[2]), coordinates.xy(corners[3])));
      area *= 0.5;
    }
    spacing = std::min(spacing, area / length);
  }
  return spacing;
}

void sort_by_spacing(DrawList& list) {
  const std::size_t count = list.line_spacing.size();
  std::vector<std::uint32_t> at_least(class_count + 1, 0);
  for (const float s : list.line_spacing) ++at_least[spacing_class(s)];
  for (std::size_t k = class_count; k-- > 0;) at_least[k] += at_least[k + 1];
  std::vector<std::uint32_t> next(at_least.begin() + 1, at_least.end());
  std::vector<std::uint32_t> lines(2 * count);
  std::vector<float> spacing(count);
  std::vector<Index> edge(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t to = next[spacing_class(list.line_spacing[k])]++;
    lines[2 * to] = list.lines[2 * k];
    lines[2 * to + 1] = list.lines[2 * k + 1];
    spacing[to] = list.line_spacing[k];
    edge[to] = list.line_edge[k];
  }
  list.lines = std::move(lines);
  list.line_spacing = std::move(spacing);
  list.line_edge = std::move(edge);
  list.interior_at_least = std::move(at_least);
}

std::size_t lines_spaced(const DrawList& list, float spacing) {
  if (list.interior_at_least.empty()) return list.interior.count;
  return list.interior_at_least[spacing_class(spacing)];
}

float merging_spacing(const DrawList& list, float width, float pixels_per_unit) {
  if (list.triangle_lines.empty() || !(width > 0)) return 0;
  const float faded = fade_distance * width / pixels_per_unit;
  const float merging = class_floor(merging_share * faded);
  const std::size_t seen = lines_spaced(list, vanishing_share * faded);
  return seen > lines_spaced(list, merging) + many_lines ? merging : 0;
}

double line_opacity(double spacing, double width) {
  const double share = spacing / (static_cast<double>(fade_distance) * width);
  const auto gone = static_cast<double>(vanishing_share);
  return std::clamp((share - gone) / (1 - gone), 0.0, 1.0);
}

}  // namespace winslow::gui
