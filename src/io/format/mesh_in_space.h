#pragma once

#include <utility>

#include "core/mesh/mesh.h"
#include "core/types.h"
#include "io/format/mesh_file.h"

namespace winslow::io {

/// The plane of a plane mesh in space, if it is not z = constant.
///
/// In-plane coordinates are (u . p, v . p) of a point p, with unit vectors u and v at right angles.
/// They depend only on the plane, so that a user's numbers mean the same for every mesh in it: (x,
/// z) for y = constant, (y, z) for x = constant. For a tilted plane the first axis is the
/// projection of the x-axis (of the y-axis, where the plane is steepest against x). The largest
/// component of the normal n = u x v is positive if along z or x, negative if along y.
class PlanePlacement {
 public:
  /// Finds the plane of points (x, y, z of each in turn, all finite). Returns nothing if a point is
  /// farther from it than 1e-9 of the extent.
  static std::optional<PlanePlacement> find(const std::vector<double>& xyz);

  const Vec3& u() const { return u_; }
  const Vec3& v() const { return v_; }
  Vec3 normal() const { return u_.cross(v_); }

  /// Number of points.
  Index size() const { return static_cast<Index>(xyz_.size() / 3); }
  /// In-plane coordinates of one of the points given to find().
  Vec2 in_plane(Index point) const;
  /// The position in space of in-plane coordinates p. If p are unchanged coordinates of a point
  /// given to find(), returns that point bit by bit. If p differ, the point keeps its distance from
  /// the plane (round-off); other points have that of the first point.
  Vec3 in_space(Index point, const Vec2& p) const;

  /// Describes the in-plane axes: "(x, z)" or "along (0.6, 0.8, 0) and (0, 0, 1)".
  std::string axes_text() const;
  /// "the plane y = 0.5", "the plane 0.6 x + 0.8 z = 2".
  std::string plane_text() const;

  /// True if the file's elements are clockwise seen against n. They are reversed in memory, and
  /// again when the mesh is written.
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

/// Corners of an element in the direction of the file. Up to eight are stored in place.
class FileCorners {
 public:
  FileCorners() = default;
  explicit FileCorners(std::span<const Index> nodes) : count_(nodes.size()) {
    if (is_long()) many_.resize(count_);
    std::ranges::copy(nodes, data());
  }

  std::size_t size() const { return count_; }
  Index operator[](std::size_t k) const { return data()[k]; }
  Index* data() { return is_long() ? many_.data() : few_.data(); }
  const Index* data() const { return is_long() ? many_.data() : few_.data(); }
  const Index* begin() const { return data(); }
  const Index* end() const { return data() + count_; }
  std::span<Index> span() { return {data(), count_}; }

 private:
  bool is_long() const { return count_ > few_.size(); }

  std::array<Index, 8> few_{};
  std::size_t count_ = 0;
  std::vector<Index> many_;  // of a polygon, or a face of a polyhedron, with more
};

/// The mesh that formats with three coordinates write: a plane mesh in the plane of its file, or a
/// volume mesh unchanged.
class MeshInSpace {
 public:
  /// details: null for a mesh of the plane z = 0. Both must outlive this object.
  MeshInSpace(const Mesh& mesh, const FormatDetails* details) : mesh_(mesh), details_(details) {}

  Vec3 node(Index i) const;
  FileCorners element(Index e) const;
  /// For a plane mesh: the unit normal against which elements are seen counter-clockwise.
  Vec3 normal() const;

 private:
  const Mesh& mesh_;
  const FormatDetails* details_;
};

/// Position of a node in space; for a plane mesh, in the plane of its file.
Vec3 place_in_space(const FormatDetails* details, const Coordinates& x, Index node);

/// Number of coordinates that a file of the mesh needs: three for a mesh in space and for a plane
/// mesh outside z = 0, else two.
int coordinates_in_file(const Mesh& mesh, const FormatDetails* details);

/// Turns the corners of a prism, as ElementShape numbers them, into those of VTK's wedge, and back.
/// In VTK's wedge the triangle 0 1 2 faces outwards.
inline void mirror_prism(std::span<Index> corners) {
  std::swap(corners[1], corners[2]);
  std::swap(corners[4], corners[5]);
}

}  // namespace winslow::io
