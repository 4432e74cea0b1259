#pragma once

#include "core/mesh/mesh.h"

namespace winslow::gui {

/// A mesh as the graphics card wants it: vertices in single precision relative to an origin, and
/// indices into them. Knows no OpenGL.
struct DrawList {
  struct Range {
    std::size_t first = 0, count = 0;  ///< in lines, if nothing else is said
  };
  Vec3 origin{0, 0, 0};
  std::vector<float> positions;          ///< x and y of each vertex, minus origin
  std::vector<float> heights;            ///< z of each vertex, minus origin; empty: all are 0
  std::vector<float> node_spacing;       ///< per vertex: shortest edge there, 0 for no node
  std::vector<std::uint32_t> triangles;  ///< 3 per triangle; quadrilaterals are cut in two
  std::vector<Index> triangle_element;   ///< per triangle
  std::vector<std::uint32_t> inverted_triangles;  ///< 3 per triangle of an inverted element
  std::vector<std::uint32_t> inverted_lines;      ///< 2 per edge of an inverted element
  std::vector<std::uint32_t> lines;  ///< 2 per line: interior, unmarked boundary, each marker
  std::vector<float> line_spacing;   ///< per line: distance to the next parallel line, world units;
                                     ///< interior lines come in its order, the widest first
  std::vector<Index> line_edge;      ///< per interior line: index into Topology::edges()
  /// Two per triangle: distance from its longest line to the corner opposite, and the length of its
  /// lines per area, half of each. Only for lists worth merging, see line_density.h; else empty.
  std::vector<float> triangle_lines;
  /// What lies nearer hides what lies behind it; else, as in the plane, what comes later lies
  /// above.
  bool depth_test = false;
  /// Triangles that are enough to draw of a mesh that lies over itself many times; see overlap.h.
  struct Seen {
    Range beside_inverted;  ///< where inverted ones are drawn above all; ranges count triangles
    Range alone;            ///< where they are not
    Range whole;            ///< every triangle as it is
    /// Last of all, with vertices of their own: where some elements are see-through, what is seen
    /// of the others, and of these one layer; see seen_through(). Empty: not asked for.
    Range through = {};
    std::size_t vertices = 0;  ///< of the list without those; 0: not asked for
  };
  std::optional<Seen> seen;  ///< none: all of them
  Range interior, boundary;
  std::vector<std::uint32_t> interior_at_least;  ///< see sort_by_spacing in line_density.h
  std::vector<Range> markers;
};

/// Edges by how they are drawn; depends on the topology alone.
struct EdgeGroups {
  std::vector<Index> interior;           ///< indices into Topology::edges()
  std::vector<Index> unmarked_boundary;  ///< likewise
};
EdgeGroups group_edges(const Topology& topology);

/// The whole mesh, vertex i is node i. Exact to 1e-7 of the distance from the origin.
DrawList whole_draw_list(const Topology& topology, const EdgeGroups& groups,
                         const Coordinates& coordinates, const Vec2& origin);

/// What lies in a box, cut off at its sides in double precision: for a zoom so deep that single
/// precision cannot tell the ends of a long edge from each other. The origin is the box's centre.
DrawList clipped_draw_list(const Topology& topology, const EdgeGroups& groups,
                           const Coordinates& coordinates, const Bounds& box);

/// Twice the signed area of a triangle.
inline double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// True if any corner has an area that is not positive (or is not a number).
bool is_inverted(const Coordinates& coordinates, std::span<const Index> corners);

/// Corners (positions in the element) of the two triangles that fill a quadrilateral: cut along the
/// diagonal that leaves no triangle turned over, where there is one.
std::array<int, 6> cut_quadrilateral(const Coordinates& coordinates,
                                     std::span<const Index> corners);

}  // namespace winslow::gui
