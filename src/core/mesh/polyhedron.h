#pragma once

#include "core/mesh/element_type.h"

/// The shape of a cell that is given by its faces:
///
///     const std::vector<winslow::Vec3> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
///     const std::vector<winslow::Face> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
///     const winslow::PolyhedronShape cell(faces, places);
///     std::printf("%zu edges\n", cell.shape().edges.size());
namespace winslow {

/// Why faces do not bound a polyhedron, in words for messages.
struct PolyhedronFault {
  std::string text;  ///< "has 5 faces at the edge between corners 0 and 1, expected 2"
};

/// Edges, links and tetrahedra of a polyhedron.
///
/// A corner is flat if its edges lie nearly in one plane: a node in the middle of an edge or of a
/// face of a hexahedron whose neighbours are split. A flat corner has no corner tetrahedron.
/// Another corner of three edges has one, and a corner of m > 3 edges has one for each three
/// consecutive edges that do not lie in one plane.
///
/// A flat corner has a face tetrahedron with two consecutive edges of a face and another corner
/// that is not flat: the one most nearly behind them. While these are positive the corner does not
/// come near the other side of the cell.
///
/// A polyhedron with the faces of a pyramid, prism or
/// hexahedron has the tetrahedra of that type unless has_flat_corner().
class PolyhedronShape {
 public:
  /// faces: by the numbers of the corners, counter-clockwise seen from outside. places: of the
  /// corners; they decide which of them are flat. Throws PolyhedronFault if the faces do not bound
  /// one solid.
  PolyhedronShape(std::span<const Face> faces, std::span<const Vec3> places);
  PolyhedronShape(const PolyhedronShape&) = delete;
  PolyhedronShape& operator=(const PolyhedronShape&) = delete;

  const ElementShape& shape() const { return shape_; }
  std::size_t bytes() const;

 private:
  void find_edges(std::size_t corners);
  void find_links(std::size_t corners);
  void find_tetrahedra(std::span<const Vec3> places);
  void add_fan(Index corner, std::span<const Vec3> places);
  void add_edge_tetrahedra(std::span<const Vec3> places);
  void add_face_tetrahedra(std::span<const Vec3> places);
  Index count_real(std::span<const Vec3> places) const;
  std::uint8_t sides_of_face(Index corner, Index next, Index previous) const;

  ElementShape shape_;
  std::vector<Face> faces_, links_;
  std::vector<std::array<Index, 2>> edges_;
  std::vector<std::array<Index, 4>> at_corners_, at_edges_, at_faces_;
  std::vector<std::array<std::uint8_t, 3>> face_sizes_;
  std::vector<bool> flat_;  // #corners
  ElementType like_ = ElementType::polyhedron;
};

/// Whether a cell with the shape of a type has a corner in a flat part of its surface, or one that
/// is inverted: the sine of a corner, its volume over that of a cube with its edges, is less than
/// 0.1, and less than a quarter of the median of all. All corners of a sheared cell are alike.
/// places: of the corners.
bool has_flat_corner(const ElementShape& type, std::span<const Vec3> places);

/// Volume of the regular volume element with unit edges, in regular tetrahedra. For a polyhedron
/// that is like no other type it follows from the number of its real corners: a power law
/// through the cube that gives the volumes of the dodecahedron and of the truncated octahedron
/// within 2 %.
double regular_volume(const ElementShape& shape);

/// Edges of the regular corner between three faces with so many corners each, as columns: unit
/// vectors at the angles of regular polygons, reduced in proportion where they would not close. The
/// faces lie between edges 0 and 1, 1 and 2, 2 and 0. Zero if a number is 0: there is no such face.
std::array<Vec3, 3> regular_corner(const std::array<std::uint8_t, 3>& face_sizes);

}  // namespace winslow
