#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/topology.h"
#include "core/search/box_tree.h"

/// A mesh from arrays of one's own:
///
///     std::vector<std::string> warnings;
///     const winslow::Mesh mesh = winslow::make_mesh(data, &warnings);
///     winslow::MeshState state = winslow::make_state(mesh);
namespace winslow {

/// A mesh: its connectivity, which smoothing never changes, and the coordinates of its nodes.
struct Mesh {
  std::shared_ptr<const Topology> topology;
  Coordinates coordinates;  ///< #nodes by 2, or by 3 in space
};

/// Builds a mesh from raw arrays and checks its topology and its geometry.
///
/// Throws MeshError for what Topology::build refuses and for: a coordinate that is not finite, an
/// element without area or volume, two nodes in the same place, a hanging node (a boundary node
/// inside another element's boundary edge or face), an element that shares no face with the rest of
/// the mesh. Adds a sentence to `warnings` for harmless faults: unused nodes, boundary faces
/// without marker, faces between regions without marker, elements that were turned. Inverted
/// elements are no error: a tangled mesh is what smoothing is for.
Mesh make_mesh(const MeshData& data, std::vector<std::string>* warnings = nullptr);

/// A part of the plane.
using Bounds = Box<2>;
/// Smallest axis-parallel box around all used nodes of a plane mesh. Throws UsageError for other
/// meshes.
Bounds bounds(const Mesh& mesh);
/// Smallest box around all used nodes of a volume mesh.
Box<3> space_bounds(const Mesh& mesh);
Box<3> space_bounds(const Coordinates& coordinates, std::span<const Index> nodes);

/// Smallest box around given nodes in the plane. Throws UsageError if there are none.
Bounds bounds(const Coordinates& coordinates, std::span<const Index> nodes);

/// Coordinates relative to a point near the mesh, for meshes far from the origin (UTM). With
/// coordinates of 1e7 chords solvers would lose seven digits to round-off.
///
/// Along each axis the point is the centre of the mesh if that is farther from 0 than 16 times the
/// extent of the mesh, else 0. All coordinates then lie between half the centre and twice the
/// centre, so that differences are exact (Sterbenz) and the way back gives the same bits.
class LocalFrame {
 public:
  /// The frame of a plane or volume mesh. Throws UsageError for a surface mesh.
  explicit LocalFrame(const Mesh& mesh);

  /// False for a mesh near the origin: the frame is that of the mesh.
  bool shifts() const { return origin_ != Vec3(0, 0, 0); }
  /// Its third component is 0 for a plane mesh.
  const Vec3& origin() const { return origin_; }

  Vec2 to_local(const Vec2& point) const { return point - origin_.head<2>(); }
  Vec3 to_local(const Vec3& point) const { return point - origin_; }
  Coordinates to_local(Coordinates x) const;
  Mesh to_local(const Mesh& mesh) const { return {mesh.topology, to_local(mesh.coordinates)}; }

  Vec2 to_mesh(const Vec2& point) const { return point + origin_.head<2>(); }
  Vec3 to_mesh(const Vec3& point) const { return point + origin_; }
  /// rest: coordinates of the mesh; x may have more nodes. Nodes at their position in `rest` get
  /// the same bits again, also those far from the mesh that no element uses.
  Coordinates to_mesh(Coordinates x, const Coordinates& rest) const;

 private:
  Vec3 origin_{0, 0, 0};
};

}  // namespace winslow
