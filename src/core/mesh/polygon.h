#pragma once

#include "core/mesh/element_type.h"

/// The shape of a plane cell with any number of corners, one of them flat:
///
///     const std::vector<winslow::Vec2> places{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}};
///     const winslow::PolygonShape cell(winslow::corners_of_polygon(places));
///     std::printf("%d of %zu corners\n", cell.shape().real_corners, places.size());
namespace winslow {

/// Largest number of corners of a polygon. What elements store grows with its square.
inline constexpr std::size_t most_polygon_corners = 1000;

/// The corners of a polygon, and the triangles at them (ElementShape::corner_triangles).
struct PolygonCorners {
  std::size_t corners = 0;
  Index real = 0;
  std::vector<std::array<Index, 3>> triangles = {};

  bool operator<(const PolygonCorners& other) const {
    return std::tie(corners, real, triangles) <
           std::tie(other.corners, other.real, other.triangles);
  }
};

/// Which corners of a polygon are flat. places: of the corners, counter-clockwise.
///
/// A corner is flat if its angle is more than about 168 degrees: its sine is below 0.2, or below
/// half of that of a regular polygon with as many corners. It is a node in the middle of a side,
/// whose neighbours beyond are split, or it is reflex, as in a cell around the end of a wall. It
/// has no triangle, unless both its neighbours are flat, too: then that with the next corner and
/// the corner which it faces. A polygon that is not simple, or clockwise, is tangled: its reflex
/// corners are not flat.
///
/// at_wall: the corners (#corners) that lie on the boundary, with both neighbours; may be empty. A
/// tangle leaves the boundary where it is, so these are as in a polygon that is not tangled.
PolygonCorners corners_of_polygon(std::span<const Vec2> places,
                                  const std::vector<bool>& at_wall = {});

/// Edges, links and triangles of all polygons with these corners.
class PolygonShape {
 public:
  explicit PolygonShape(PolygonCorners corners);
  PolygonShape(const PolygonShape&) = delete;
  PolygonShape& operator=(const PolygonShape&) = delete;

  const ElementShape& shape() const { return shape_; }
  std::size_t bytes() const;

 private:
  ElementShape shape_;
  PolygonCorners corners_;
  std::vector<Face> faces_, links_;
  std::vector<std::array<Index, 2>> edges_, side_edges_;
  std::vector<Index> mirrored_;
};

/// Whether a corner of a plane element is flat.
bool is_flat_corner(const ElementShape& shape, std::size_t corner);

/// Number of corners of the regular polygon that a plane element would be: at least 3.
inline int regular_sides(const ElementShape& shape) {
  return std::max<Index>(3, shape.real_corners);
}
/// Angle of its corners, in radians.
inline double regular_angle(const ElementShape& shape) {
  const int n = regular_sides(shape);
  return n == 3 ? pi / 3 : pi * (1 - 2.0 / n);
}
/// Its area with unit edges, in regular triangles.
double regular_area(const ElementShape& shape);

/// Whether no two edges of a polygon cross. places: of the corners, in order.
bool is_simple(std::span<const Vec2> places);

/// Cuts a polygon into triangles, by numbers of corners, two fewer than it has corners. Those of a
/// simple counter-clockwise polygon cover it and overlap nowhere; thin triangles are avoided.
/// (Ear clipping, the best ear first: G. H. Meisters, Amer. Math. Monthly 82, 1975.)
std::vector<std::array<Index, 3>> cut_polygon(std::span<const Vec2> places);

/// The same of a face in space, as it is seen along its normal. A face without area is cut by the
/// diagonals from its first corner.
std::vector<std::array<Index, 3>> cut_face(std::span<const Vec3> places);

/// The places of the corners of a plane element.
std::vector<Vec2> places_of(const Coordinates& x, std::span<const Index> corners);

}  // namespace winslow
