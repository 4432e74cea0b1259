#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// Numerator and denominator of tan(Omega / 2), Omega the solid angle of the triangle a b c of unit
/// vectors (A. van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Trans.
/// Biomed. Eng. 30(2), 1983): N = a . (b x c), D = 1 + a . b + b . c + c . a.
struct SolidAngleTangent {
  double n, d;
};

inline SolidAngleTangent solid_angle_tangent(const Vec3& a, const Vec3& b, const Vec3& c) {
  // Uses differences to avoid cancellation in small triangles.
  return {a.dot((b - a).cross(c - a)), 1 + a.dot(b) + b.dot(c) + c.dot(a)};
}

/// Solid angle, in steradians, of the spherical triangle a b c of unit vectors: in (-2 pi, 2 pi],
/// positive if it is counter-clockwise seen from outside. A triangle larger than half of the sphere
/// counts as its complement, seen from inside; with two opposite corners the angle is undefined.
inline double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const SolidAngleTangent t = solid_angle_tangent(a, b, c);
  return 2 * std::atan2(t.n, t.d);
}

/// A solid angle and its derivatives by the corners. Only the component of each derivative in the
/// tangent plane of its corner is meaningful.
struct SolidAngleGradient {
  double angle;
  Vec3 by_a, by_b, by_c;
};

/// See solid_angle(). With two opposite corners the derivatives are zero.
inline SolidAngleGradient solid_angle_gradient(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto [n, d] = solid_angle_tangent(a, b, c);
  const double square = n * n + d * d;
  const double scale = square > 0 ? 2 / square : 0;
  const double dn = scale * d, dd = -scale * n;  // of Omega, by N and by D
  return {2 * std::atan2(n, d), dn * b.cross(c) + dd * (b + c), dn * c.cross(a) + dd * (c + a),
          dn * a.cross(b) + dd * (a + b)};
}

/// The link of an interior node of a volume mesh as a triangulated sphere: vertex k is neighbour k
/// of the node, triangles are counter-clockwise seen from outside.
///
/// It is a simplicial complex (no two edges have the same ends) and a sphere, so that its edges
/// form a 3-connected planar graph, as the embedding in SphereStart requires. Half-edge 3 t + k
/// leads from corner k of triangle t to the next.
class SphereLink {
 public:
  using Triangle = std::array<Index, 3>;

  SphereLink() = default;
  /// See assign().
  SphereLink(Index vertices, std::span<const Triangle> triangles) { assign(vertices, triangles); }
  SphereLink(const Topology& topology, Index node) { assign(topology, node); }

  /// Replaces the triangles and reuses the memory. Throws UsageError with the reason unless they
  /// form a sphere as above: for a vertex out of range or without triangles, an edge without one
  /// triangle on either side, a vertex where two parts meet, several parts, or handles.
  void assign(Index vertices, std::span<const Triangle> triangles);
  /// Assigns the link of an interior node of a volume mesh: the triangle that the node's neighbours
  /// in each element form. At a pyramid's apex the quadrilateral is split along the diagonal from
  /// its lowest node. Throws UsageError for a boundary node or a node of another mesh; MeshError,
  /// naming the node, if the link is no sphere as above.
  void assign(const Topology& topology, Index node);

  Index vertex_count() const { return static_cast<Index>(first_.size()) - 1; }
  Index triangle_count() const { return static_cast<Index>(triangles_.size()); }
  std::span<const Triangle> triangles() const { return triangles_; }

  /// The next half-edge around the triangle, and the previous one.
  static Index next_of(Index half_edge) {
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
  }
  static Index previous_of(Index half_edge) {
    return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
  }
  /// The half-edge on the other side.
  Index twin(Index half_edge) const { return twins_[at(half_edge)]; }
  Index start_of(Index half_edge) const { return triangles_[at(half_edge / 3)][at(half_edge % 3)]; }
  Index end_of(Index half_edge) const { return ends_[at(half_edge)]; }
  /// Half-edges that start at a vertex, one per neighbour, in no particular order.
  std::span<const Index> outgoing(Index vertex) const {
    return std::span(outgoing_).subspan(at(first_[at(vertex)]), at(degree(vertex)));
  }
  Index degree(Index vertex) const { return first_[at(vertex) + 1] - first_[at(vertex)]; }

 private:
  void collect_outgoing(Index vertices);
  void pair_half_edges();
  void check_rings() const;
  void check_whole() const;

  std::vector<Triangle> triangles_;
  std::vector<Index> ends_;              // by half-edge
  std::vector<Index> twins_;             // by half-edge
  std::vector<Index> first_, outgoing_;  // rows of half-edges by vertex
};

}  // namespace winslow
