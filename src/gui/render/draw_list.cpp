#include "gui/render/draw_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "gui/render/element_shape.h"
#include "gui/render/line_density.h"
#include "gui/render/overlap.h"

namespace winslow::gui {
namespace {

std::uint64_t edge_key(Index a, Index b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b));
  const auto high = static_cast<std::uint64_t>(std::max(a, b));
  return (high << 32U) | low;
}

/// Fills a DrawList whose vertices are the nodes.
class WholeMesh {
 public:
  WholeMesh(const Topology& topology, const Coordinates& coordinates, const Vec2& origin)
      : topology_(topology), coordinates_(coordinates) {
    list_.origin = {origin.x(), origin.y(), 0};
  }

  DrawList build(const EdgeGroups& groups) {
    add_nodes();
    add_elements(groups.interior.size() > many_lines);
    list_.interior = add_edges(groups.interior);
    list_.line_edge = groups.interior;
    hide_covered(list_);
    sort_by_spacing(list_);
    list_.boundary = add_edges(groups.unmarked_boundary);
    for (const Marker& marker : topology_.markers()) {
      const DrawList::Range range{list_.lines.size() / 2, marker.faces.size()};
      for (const Face& edge : marker.faces) add_line(edge[0], edge[1], 0);
      list_.markers.push_back(range);
    }
    return std::move(list_);
  }

 private:
  void add_nodes() {
    const auto n = static_cast<std::size_t>(coordinates_.size());
    list_.positions.reserve(2 * n);
    list_.node_spacing.assign(n, 0.0f);
    for (Index i = 0; i < coordinates_.size(); ++i) {
      const Vec2 p = coordinates_.xy(i) - list_.origin.head<2>();
      list_.positions.push_back(static_cast<float>(p.x()));
      list_.positions.push_back(static_cast<float>(p.y()));
      double shortest = std::numeric_limits<double>::infinity();
      for (const Index j : topology_.neighbours(i)) {
        shortest = std::min(shortest, (coordinates_.xy(j) - coordinates_.xy(i)).squaredNorm());
      }
      if (topology_.used(i)) {
        list_.node_spacing[static_cast<std::size_t>(i)] = static_cast<float>(std::sqrt(shortest));
      }
    }
  }

  void add_elements(bool with_lines) {
    const auto elements = static_cast<std::size_t>(topology_.element_count());
    list_.triangles.reserve(3 * elements);
    list_.triangle_element.reserve(elements);
    if (with_lines) list_.triangle_lines.reserve(2 * elements);
    for (Index e = 0; e < topology_.element_count(); ++e) {
      const auto corners = topology_.element(e);
      std::array<int, 6> cut{0, 1, 2, 0, 0, 0};
      if (corners.size() == 4) cut = cut_quadrilateral(coordinates_, corners);
      const std::size_t used = corners.size() == 4 ? 6 : 3;
      const bool inverted = is_inverted(coordinates_, corners);
      for (std::size_t k = 0; k < used; ++k) {
        const auto node = static_cast<std::uint32_t>(corners[static_cast<std::size_t>(cut[k])]);
        list_.triangles.push_back(node);
        if (inverted) list_.inverted_triangles.push_back(node);
        if (k % 3 == 0) list_.triangle_element.push_back(e);
        if (k % 3 == 0 && with_lines) add_triangle_lines(corners, {cut[k], cut[k + 1], cut[k + 2]});
      }
      if (inverted) add_outline(corners);
    }
  }

  /// The diagonal that cuts a quadrilateral is no line.
  void add_triangle_lines(std::span<const Index> corners, const std::array<int, 3>& cut) {
    std::array<Vec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = coordinates_.xy(corners[static_cast<std::size_t>(cut[k])]);
    double longest = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (corners.size() == 4 && std::abs(cut[(k + 1) % 3] - cut[k]) == 2) continue;
      const double length = (p[(k + 1) % 3] - p[k]).norm();
      longest = std::max(longest, length);
      sum += length;
    }
    const double area = std::abs(twice_area(p[0], p[1], p[2]));
    list_.triangle_lines.push_back(longest > 0 ? static_cast<float>(area / longest) : 0.0f);
    list_.triangle_lines.push_back(area > 0 ? static_cast<float>(sum / area) : 0.0f);
  }

  void add_outline(std::span<const Index> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      list_.inverted_lines.push_back(static_cast<std::uint32_t>(corners[k]));
      list_.inverted_lines.push_back(static_cast<std::uint32_t>(corners[(k + 1) % corners.size()]));
    }
  }

  DrawList::Range add_edges(const std::vector<Index>& edges) {
    const DrawList::Range range{list_.lines.size() / 2, edges.size()};
    for (const Index index : edges) {
      const auto& edge = topology_.edges()[static_cast<std::size_t>(index)];
      add_line(edge.nodes[0], edge.nodes[1], edge_spacing(topology_, coordinates_, edge));
    }
    return range;
  }

  void add_line(Index a, Index b, double spacing) {
    list_.lines.push_back(static_cast<std::uint32_t>(a));
    list_.lines.push_back(static_cast<std::uint32_t>(b));
    list_.line_spacing.push_back(static_cast<float>(spacing));
  }

  const Topology& topology_;
  const Coordinates& coordinates_;
  DrawList list_;
};

}  // namespace

EdgeGroups group_edges(const Topology& topology) {
  std::vector<std::uint64_t> marked;
  for (const Marker& marker : topology.markers()) {
    for (const Face& edge : marker.faces) marked.push_back(edge_key(edge[0], edge[1]));
  }
  std::ranges::sort(marked);
  EdgeGroups groups;
  const auto edges = topology.edges();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto& edge = edges[k];
    if (std::ranges::binary_search(marked, edge_key(edge.nodes[0], edge.nodes[1]))) continue;
    auto& group = edge.elements[1] < 0 ? groups.unmarked_boundary : groups.interior;
    group.push_back(static_cast<Index>(k));
  }
  return groups;
}

DrawList whole_draw_list(const Topology& topology, const EdgeGroups& groups,
                         const Coordinates& coordinates, const Vec2& origin) {
  return WholeMesh(topology, coordinates, origin).build(groups);
}

}  // namespace winslow::gui
