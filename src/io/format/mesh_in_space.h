#pragma once

#include <utility>

#include "core/mesh/mesh.h"
#include "core/types.h"
#include "io/format/mesh_file.h"

namespace winslow::io {

/// Where in space a plane mesh lies whose plane is not z = constant.
///
/// In-plane coordinates are (u . p, v . p) of a point p, with unit vectors u and v at right angles.
/// They depend on the plane alone, so that numbers that a user types mean the same for every mesh
/// in it: (x, z) for y = constant, (y, z) for x = constant. For a tilted plane the first axis is
/// the projection of the x-axis (of the y-axis, where the plane is steepest against x), and the
/// normal n = u x v has a positive component along z, a negative one along y, or a positive one
/// along x, whichever is the largest.
class PlanePlacement {
 public:
  /// The plane of points: x, y, z of one after the other, all finite. None if one of them is
  /// farther from it than 1e-9 of the extent.
  static std::optional<PlanePlacement> find(const std::vector<double>& xyz);

  const Vec3& u() const { return u_; }
  const Vec3& v() const { return v_; }
  Vec3 normal() const { return u_.cross(v_); }

  /// Number of points.
  Index size() const { return static_cast<Index>(xyz_.size() / 3); }
  /// In-plane coordinates of a point that it was found by.
  Vec2 in_plane(Index point) const;
  /// A point of in-plane coordinates p. One of those that the plane was found by, where p are its
  /// coordinates: bit by bit as it was; elsewhere it keeps its distance from the plane (round-off),
  /// and others have that of the first point.
  Vec3 in_space(Index point, const Vec2& p) const;

  /// "(x, z)" or "along (0.6, 0.8, 0) and (0, 0, 1)": what in-plane coordinates are.
  std::string axes_text() const;
  /// "the plane y = 0.5", "the plane 0.6 x + 0.8 z = 2".
  std::string plane_text() const;

  /// Elements of the file go round the other way than seen against n: they are turned in memory,
  /// and back when the mesh is written.
  bool from_behind = false;

 private:
  PlanePlacement(std::vector<double> xyz, const Vec3& u, const Vec3& v)
      : xyz_(std::move(xyz)), u_(u), v_(v) {}
  Vec3 point(Index i) const;

  std::vector<double> xyz_;
  Vec3 u_, v_;
};

/// Largest distance of points (as above, at least one) from the plane that fits them best.
double distance_from_plane(const std::vector<double>& xyz);

/// Corners of an element in the direction of the file.
struct FileCorners {
  std::array<Index, 8> nodes{};
  std::size_t count = 0;

  std::size_t size() const { return count; }
  Index operator[](std::size_t k) const { return nodes[k]; }
  const Index* data() const { return nodes.data(); }
  const Index* begin() const { return nodes.data(); }
  const Index* end() const { return nodes.data() + count; }
};

/// A plane mesh where its file had it, or a volume mesh as it is: what formats with three
/// coordinates write.
class MeshInSpace {
 public:
  /// details: null for a mesh of the plane z = 0. Both have to outlive this.
  MeshInSpace(const Mesh& mesh, const FormatDetails* details) : mesh_(mesh), details_(details) {}

  Vec3 node(Index i) const;
  FileCorners element(Index e) const;
  /// Of a plane mesh: against which elements go round counter-clockwise; a unit vector.
  Vec3 normal() const;

 private:
  const Mesh& mesh_;
  const FormatDetails* details_;
};

/// Where a node is: of a plane mesh, where the file had its plane.
Vec3 place_in_space(const FormatDetails* details, const Coordinates& x, Index node);

/// How many coordinates a file of the mesh needs: three of a mesh in space, and of a plane one that
/// does not lie in z = 0.
int coordinates_in_file(const Mesh& mesh, const FormatDetails* details);

/// Turns the corners of a prism, as ElementShape numbers them, into those of VTK's wedge, and back:
/// its triangle 0 1 2 faces outwards.
inline void mirror_prism(std::span<Index> corners) {
  std::swap(corners[1], corners[2]);
  std::swap(corners[4], corners[5]);
}

}  // namespace winslow::io
