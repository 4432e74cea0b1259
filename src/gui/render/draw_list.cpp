#include "gui/render/draw_list.h"

#include <bit>

#include "core/quality/quality.h"
#include "gui/base/screen.h"
#include "gui/render/overlap.h"

namespace winslow::gui {
namespace {

std::uint64_t edge_key(Index a, Index b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b));
  const auto high = static_cast<std::uint64_t>(std::max(a, b));
  return (high << 32U) | low;
}

/// Base of the classes that fill a DrawList with a mesh.
class MeshFiller {
 protected:
  MeshFiller(const Topology& topology, const Coordinates& coordinates, const Vec2& origin)
      : topology_(topology), coordinates_(coordinates) {
    list_.origin << origin, 0;
  }

  void add_position(const Vec2& world) {
    const Vec2 p = world - list_.origin.head<2>();
    list_.positions.push_back(static_cast<float>(p.x()));
    list_.positions.push_back(static_cast<float>(p.y()));
  }
  double shortest_edge(Index node) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Index j : topology_.neighbours(node))
      shortest = std::min(shortest, (coordinates_.xy(j) - coordinates_.xy(node)).squaredNorm());
    return std::sqrt(shortest);
  }
  /// Corners of the triangles of an element.
  const std::vector<std::array<Index, 3>>& cut(Index e) {
    cut_element(topology_, coordinates_, e, triangles_);
    return triangles_;
  }

  const Topology& topology_;
  const Coordinates& coordinates_;
  DrawList list_;

 private:
  std::vector<std::array<Index, 3>> triangles_;  // work memory
};

/// Fills a DrawList with the whole mesh; vertices are nodes.
class WholeMesh : MeshFiller {
 public:
  WholeMesh(const Topology& topology, const Coordinates& coordinates, const Vec2& origin)
      : MeshFiller(topology, coordinates, origin) {}

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
      add_position(coordinates_.xy(i));
      if (topology_.used(i)) list_.node_spacing[at(i)] = static_cast<float>(shortest_edge(i));
    }
  }

  void add_elements(bool with_lines) {
    const auto elements = static_cast<std::size_t>(topology_.element_count());
    list_.triangles.reserve(3 * elements);
    list_.triangle_element.reserve(elements);
    if (with_lines) list_.triangle_lines.reserve(2 * elements);
    for (Index e = 0; e < topology_.element_count(); ++e) {
      const auto corners = topology_.element(e);
      const bool inverted = shows_inverted(topology_, coordinates_, e);
      for (const auto& triangle : cut(e)) {
        for (const Index k : triangle) {
          const auto node = static_cast<std::uint32_t>(corners[at(k)]);
          list_.triangles.push_back(node);
          if (inverted) list_.inverted_triangles.push_back(node);
        }
        list_.triangle_element.push_back(e);
        if (with_lines) add_triangle_lines(corners, triangle);
      }
      if (inverted) add_outline(corners);
    }
  }

  /// The diagonals that cut an element do not count as lines.
  void add_triangle_lines(std::span<const Index> corners, const std::array<Index, 3>& cut) {
    const auto last = static_cast<Index>(corners.size()) - 1;
    std::array<Vec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = coordinates_.xy(corners[at(cut[k])]);
    double longest = 0;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index apart = std::abs(cut[(k + 1) % 3] - cut[k]);
      if (apart != 1 && apart != last) continue;
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
      const auto& edge = topology_.edges()[at(index)];
      add_line(edge.nodes[0], edge.nodes[1], edge_spacing(topology_, coordinates_, edge));
    }
    return range;
  }

  void add_line(Index a, Index b, double spacing) {
    list_.lines.push_back(static_cast<std::uint32_t>(a));
    list_.lines.push_back(static_cast<std::uint32_t>(b));
    list_.line_spacing.push_back(static_cast<float>(spacing));
  }
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

namespace {

/// Fills a DrawList with the part of a mesh in a box; every piece has vertices of its own.
class ClippedMesh : MeshFiller {
 public:
  ClippedMesh(const Topology& topology, const Coordinates& coordinates, const Bounds& box)
      : MeshFiller(topology, coordinates, box.centre()), box_(box) {}

  DrawList build(const EdgeGroups& groups) {
    for (Index e = 0; e < topology_.element_count(); ++e) add_element(e);
    list_.interior = add_edges(groups.interior);
    // Only for the interior: lines added later are never hidden with their elements.
    list_.line_edge = std::move(edges_);
    hide_covered(list_);
    sort_by_spacing(list_);
    list_.boundary = add_edges(groups.unmarked_boundary);
    for (const Marker& marker : topology_.markers()) {
      const std::size_t first = list_.lines.size() / 2;
      for (const Face& edge : marker.faces) {
        if (add_segment(edge[0], edge[1], list_.lines)) list_.line_spacing.push_back(0);
      }
      list_.markers.push_back({first, list_.lines.size() / 2 - first});
    }
    for (Index i = 0; i < coordinates_.size(); ++i) add_node(i);
    return std::move(list_);
  }

 private:
  std::uint32_t add_vertex(const Vec2& world, double spacing = 0) {
    add_position(world);
    list_.node_spacing.push_back(static_cast<float>(spacing));
    return static_cast<std::uint32_t>(list_.node_spacing.size() - 1);
  }

  bool misses_box(std::span<const Index> corners) const {
    Vec2 low = coordinates_.xy(corners[0]);
    Vec2 high = low;
    for (const Index node : corners.subspan(1)) {
      low = low.cwiseMin(coordinates_.xy(node));
      high = high.cwiseMax(coordinates_.xy(node));
    }
    return (low.array() > box_.max.array()).any() || (high.array() < box_.min.array()).any();
  }

  void add_element(Index e) {
    const auto corners = topology_.element(e);
    if (misses_box(corners)) return;
    const bool inverted = shows_inverted(topology_, coordinates_, e);
    for (const auto& [a, b, c] : cut(e))
      add_triangle({coordinates_.xy(corners[at(a)]), coordinates_.xy(corners[at(b)]),
                    coordinates_.xy(corners[at(c)])},
                   e, inverted);
    if (!inverted) return;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      add_segment(corners[k], corners[(k + 1) % corners.size()], list_.inverted_lines);
    }
  }

  void add_triangle(const std::array<Vec2, 3>& triangle, Index element, bool inverted) {
    std::vector<Vec2> polygon(triangle.begin(), triangle.end());
    for (const int axis : {0, 1}) {
      polygon = cut_side(polygon, axis, box_.min[axis], -1);
      polygon = cut_side(polygon, axis, box_.max[axis], 1);
    }
    if (polygon.size() < 3) return;
    std::vector<std::uint32_t> vertices;
    for (const Vec2& p : polygon) vertices.push_back(add_vertex(p));
    for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
      const std::array<std::uint32_t, 3> piece{vertices[0], vertices[k], vertices[k + 1]};
      list_.triangles.insert(list_.triangles.end(), piece.begin(), piece.end());
      list_.triangle_element.push_back(element);
      if (inverted) {
        list_.inverted_triangles.insert(list_.inverted_triangles.end(), piece.begin(), piece.end());
      }
    }
  }

  /// False if nothing of the segment lies in the box.
  bool add_segment(Index from, Index to, std::vector<std::uint32_t>& lines) {
    const Vec2 a = coordinates_.xy(from);
    const Vec2 d = coordinates_.xy(to) - a;
    const auto part = part_within<Vec2>(a, coordinates_.xy(to), box_);
    if (!part) return false;
    const auto [enter, leave] = *part;
    lines.push_back(add_vertex(enter > 0 ? Vec2(a + enter * d) : a));
    lines.push_back(add_vertex(leave < 1 ? Vec2(a + leave * d) : coordinates_.xy(to)));
    return true;
  }

  DrawList::Range add_edges(const std::vector<Index>& edges) {
    const std::size_t first = list_.lines.size() / 2;
    for (const Index index : edges) {
      const auto& edge = topology_.edges()[at(index)];
      if (misses_box(edge.nodes)) continue;
      if (!add_segment(edge.nodes[0], edge.nodes[1], list_.lines)) continue;
      list_.line_spacing.push_back(static_cast<float>(edge_spacing(topology_, coordinates_, edge)));
      edges_.push_back(index);
    }
    return {first, list_.lines.size() / 2 - first};
  }

  void add_node(Index node) {
    const Vec2 p = coordinates_.xy(node);
    if (!topology_.used(node) || (p.array() < box_.min.array()).any() ||
        (p.array() > box_.max.array()).any()) {
      return;
    }
    add_vertex(p, shortest_edge(node));
  }

  const Bounds box_;
  std::vector<Index> edges_;  // of the lines added by add_edges
};

}  // namespace

DrawList clipped_draw_list(const Topology& topology, const EdgeGroups& groups,
                           const Coordinates& coordinates, const Bounds& box) {
  return ClippedMesh(topology, coordinates, box).build(groups);
}

bool shows_inverted(const Topology& topology, const Coordinates& coordinates, Index element) {
  return topology.element_type(element) == ElementType::polygon
             ? winslow::is_inverted(topology, coordinates, element)
             : is_inverted(coordinates, topology.element(element));
}

bool is_inverted(const Coordinates& coordinates, std::span<const Index> corners) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double area = twice_area(coordinates.xy(corners[k]), coordinates.xy(corners[(k + 1) % n]),
                                   coordinates.xy(corners[(k + n - 1) % n]));
    if (!(area > 0)) return true;
    if (n == 3) break;
  }
  return false;
}

std::array<int, 6> cut_quadrilateral(const Coordinates& coordinates,
                                     std::span<const Index> corners) {
  const std::array<Vec2, 4> p{coordinates.xy(corners[0]), coordinates.xy(corners[1]),
                              coordinates.xy(corners[2]), coordinates.xy(corners[3])};
  const double along_02 = std::min(twice_area(p[0], p[1], p[2]), twice_area(p[0], p[2], p[3]));
  const double along_13 = std::min(twice_area(p[0], p[1], p[3]), twice_area(p[1], p[2], p[3]));
  if (along_02 <= 0 && along_13 > along_02) return {0, 1, 3, 1, 2, 3};
  return {0, 1, 2, 0, 2, 3};
}

void cut_element(const Topology& topology, const Coordinates& coordinates, Index element,
                 std::vector<std::array<Index, 3>>& triangles) {
  const auto corners = topology.element(element);
  if (topology.element_type(element) == ElementType::polygon) {
    triangles = cut_polygon(places_of(coordinates, corners));
  } else if (corners.size() == 4) {
    const auto [a, b, c, d, e, f] = cut_quadrilateral(coordinates, corners);
    triangles.assign({{a, b, c}, {d, e, f}});
  } else {
    triangles.assign(1, {0, 1, 2});
  }
}

namespace {

constexpr std::size_t class_count = 2048;

/// Class of a spacing: exponent and first three bits of the fraction, which grow with the value.
std::size_t spacing_class(float spacing) {
  return (std::bit_cast<std::uint32_t>(std::max(spacing, 0.0f)) >> 20U) & (class_count - 1);
}

/// The smallest spacing in the class of a spacing; lines_spaced() is exact for it.
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
    if (corners.size() > 4) {
      spacing = std::min(spacing, 0.5 * std::abs(signed_area2(coordinates, corners)) / length);
      continue;
    }
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
