#pragma once

#include "core/mesh/mesh.h"

namespace winslow::gui {

/// A mesh in the form that the graphics card needs: vertices in single precision relative to an
/// origin, and indices into them. Independent of OpenGL.
struct DrawList {
  struct Range {
    std::size_t first = 0, count = 0;  ///< in lines, unless stated otherwise
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
                                     ///< interior lines are sorted by it, the widest first
  std::vector<Index> line_edge;      ///< per interior line: index into Topology::edges()
  /// Two per triangle: distance from its longest line to the opposite corner, and the length of its
  /// lines per area, each counted half. Only for lists worth merging, see many_lines; else empty.
  std::vector<float> triangle_lines;
  /// Nearer items hide those behind them; else, as in the plane, later items lie above.
  bool depth_test = false;
  /// Triangles that suffice to draw a mesh that overlaps itself many times; see overlap.h.
  struct Seen {
    Range beside_inverted;  ///< if inverted ones are drawn above all; ranges count triangles
    Range alone;            ///< if they are not
    Range whole;            ///< every triangle as it is
    /// If some elements are see-through: the visible parts of the others, and one layer of these;
    /// see seen_through(). Last in the list, with vertices of their own. Empty: not asked for.
    Range through = {};
    std::size_t vertices = 0;  ///< of the list without those of `through`; 0: not asked for
  };
  std::optional<Seen> seen;  ///< none: all of them
  Range interior, boundary;
  std::vector<std::uint32_t> interior_at_least;  ///< see sort_by_spacing in draw_list.h
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

/// The part of the mesh in a box, clipped in double precision: for a zoom so deep that single
/// precision cannot tell the ends of a long edge from each other. The origin is the box's centre.
DrawList clipped_draw_list(const Topology& topology, const EdgeGroups& groups,
                           const Coordinates& coordinates, const Bounds& box);

/// Twice the signed area of a triangle.
inline double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// True if any corner of a triangle or quadrilateral has an area that is not positive (or is not a
/// number).
bool is_inverted(const Coordinates& coordinates, std::span<const Index> corners);
/// The same of any plane element; of a polygon as winslow::is_inverted() has it.
bool shows_inverted(const Topology& topology, const Coordinates& coordinates, Index element);

/// Corners (positions in the element) of the triangles that fill a plane element, in `triangles`,
/// of which the memory is used again.
void cut_element(const Topology& topology, const Coordinates& coordinates, Index element,
                 std::vector<std::array<Index, 3>>& triangles);

/// Corners (positions in the element) of the two triangles that fill a quadrilateral: cut along a
/// diagonal that leaves no triangle turned over, if there is one.
std::array<int, 6> cut_quadrilateral(const Coordinates& coordinates,
                                     std::span<const Index> corners);

/// How dense lines are, and how many of them are worth drawing.

/// Distance from an edge to the opposite side of its thinnest element. Layers of long, thin cells
/// are dense across their long edges only, which the length of an edge would not show.
double edge_spacing(const Topology& topology, const Coordinates& coordinates,
                    const Topology::Edge& edge);

/// Lines closer together than fade_distance times their width fade in proportion: triangles have
/// three families of lines, which then cover half of the surface together. At vanishing_share of
/// that distance, a third of a pixel for thin lines, they are gone and only the colours remain.
inline constexpr float fade_distance = 6.0f;
inline constexpr float vanishing_share = 0.06f;

/// Lines closer together than this share of fade_distance times their width cannot be told apart.
/// If there are very many, the surface has their mean colour instead, which costs next to nothing
/// and does not flicker. Up to twice that spacing, lines fade into the surface.
inline constexpr float merging_share = 0.25f;
inline constexpr std::size_t many_lines = 150'000;

/// The spacing below which a list's lines are merged into its triangles, in units of the mesh; 0:
/// the lines are too few to merge. pixels_per_unit: of the view.
float merging_spacing(const DrawList& list, float width, float pixels_per_unit);

/// Opacity, 0 to 1, of a line of that width among others at that distance (both in pixels).
double line_opacity(double spacing, double width);

/// Puts the interior lines of a list in the order of their spacing, the widest first, in one pass
/// (a coarse order: 2048 classes). Seen from afar, a graded mesh then needs only its first lines.
/// Call it while they are the list's only lines.
void sort_by_spacing(DrawList& list);

/// Number of leading interior lines that include all whose spacing is at least this.
std::size_t lines_spaced(const DrawList& list, float spacing);

}  // namespace winslow::gui
