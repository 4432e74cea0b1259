#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/mesh_data.h"
#include "io/openfoam/poly_mesh.h"

/// Meshes of one layer of cells that stand for a plane mesh.
namespace winslow::io::openfoam {

/// How the nodes of a plane mesh stand for the points of a mesh one cell thick: OpenFOAM's form of
/// a plane mesh, between two copies of one plane (patches of type `empty`), and of an axisymmetric
/// mesh, a wedge between two planes through its axis (patches of type `wedge`).
///
/// The plane mesh of a flat mesh lies in the plane of its base, whose coordinates are those of the
/// file. That of a wedge has the coordinate along the axis and the distance from it. Both are in
/// the order x, y, z of the axes, so that a wedge about y has (r, y) if it lies along x.
class ThinMesh {
 public:
  /// What find() has found: a thin mesh, or why a mesh with such patches is none.
  struct Found;
  /// Finds the two sides of a mesh with patches of type empty or wedge: each cell has one face on
  /// each. The copies must match up to a twentieth of the shortest edge there.
  static Found find(const PolyMesh& mesh);

  bool is_wedge() const { return wedge_; }
  Index node_count() const { return static_cast<Index>(base_.size()); }
  /// Coordinates of the points of the base, in space; of a wedge, in its middle plane.
  const std::vector<double>& places() const { return places_; }
  /// The node of a point; -1: none, no face has the point.
  Index node_of(Index point) const { return node_of_[at(point)]; }
  bool on_axis(Index node) const { return base_[at(node)] == copy_[at(node)]; }
  /// Face of each cell on the base and on the copy.
  const std::vector<Index>& base_faces() const { return base_faces_; }
  const std::vector<Index>& copy_faces() const { return copy_faces_; }
  /// The edge of the plane mesh for which a face between the sides stands; of other faces nothing.
  std::optional<Face> edge_of(std::span<const Index> face) const;
  /// The patches of the sides.
  bool is_side(std::size_t patch) const { return is_side_[patch]; }
  /// Whether a patch has faces of the base, and of the copy.
  std::pair<bool, bool> sides_of(std::size_t patch) const { return sides_of_[patch]; }
  /// "a wedge of 5 degrees about the x-axis: its coordinates are (x, r), r along y".
  std::string description() const;

  /// The points of the mesh for positions of the nodes: in the plane of the base and in its copy,
  /// or turned by half the angle both ways. Points of nodes that did not move keep their bits, and
  /// so do the coordinates across the planes of a flat mesh.
  std::vector<double> points(const Coordinates& nodes) const;

  /// The position of one of the two copies of a place of the plane mesh; of new nodes.
  Vec3 base_point(const Vec2& place) const { return point_of(place, -1); }
  Vec3 copy_point(const Vec2& place) const { return point_of(place, 1); }

 private:
  bool set_axes(const PolyMesh& mesh, std::string& why);
  bool set_wedge_axes(const PolyMesh& mesh, std::string& why);
  bool sort_faces(const PolyMesh& mesh, std::string& why);
  bool pair_points(const PolyMesh& mesh, std::string& why);
  bool check_copies(const PolyMesh& mesh, std::string& why);
  void set_places();
  /// Coordinates of the plane mesh, of a point of the base or of the copy.
  Vec2 in_plane(const Vec3& point) const;
  double across(const Vec3& point) const { return point[across_]; }
  Vec3 point_of(const Vec2& place, int side) const;

  bool wedge_ = false;
  int across_ = 2;                 ///< axis at right angles to the (middle) plane
  std::array<int, 2> axes_{0, 1};  ///< axes in the plane, ascending
  double low_ = 0, high_ = 0;      ///< of a flat mesh: its planes
  // Of a wedge:
  int along_ = 0, radial_ = 1;                ///< axis of rotation; axis of the radius
  double half_angle_ = 0;                     ///< radians
  double axis_radial_ = 0, axis_across_ = 0;  ///< where the axis of rotation is
  double direction_ = 1;                      ///< of the radius along its axis
  bool base_is_low_ = true;                   ///< the base is the side of the lower coordinate

  std::vector<double> xyz_;         ///< of the file
  std::vector<Index> base_, copy_;  ///< points of each node; the same on the axis
  std::vector<Index> node_of_;
  std::vector<Index> base_faces_, copy_faces_;
  std::vector<bool> is_side_;
  std::vector<std::pair<bool, bool>> sides_of_;  ///< of each patch: base, copy
  std::vector<double> places_;
};

struct ThinMesh::Found {
  std::shared_ptr<const ThinMesh> mesh;  ///< null: none
  /// Why a mesh with patches of these types is none; empty: it has no such patches.
  std::string why;
};

}  // namespace winslow::io::openfoam
