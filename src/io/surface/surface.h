#pragma once

#include <set>

#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"
#include "io/format/mesh_in_space.h"

/// Formats made for surfaces in space: vertices and faces, no markers. (OpenMesh reads and writes
/// them in single precision only, so it serves here as the check in the tests, not as the reader.)
namespace winslow::io::surface {

extern const MeshFormat obj_format, off_format, ply_format, stl_format;

/// Collects vertices and faces as a reader meets them.
class Builder {
 public:
  explicit Builder(const Source& source) : source_(source) {
    mesh_.details = std::make_shared<FormatDetails>();
  }
  ParsedMesh& mesh() { return mesh_; }
  /// Notes that the file holds what a mesh does not: "colours", "groups", ... Said once each.
  void drops(const std::string& what) { dropped_.insert(what); }
  Index vertices() const { return static_cast<Index>(xyz_.size() / 3); }

  void add_vertex(double x, double y, double z, std::size_t offset);
  /// Throws InputError if it is neither a triangle nor a quadrilateral. Vertices may follow later.
  void add_face(std::span<const Index> corners, std::size_t offset);
  /// Throws InputError if there is no face, or if a coordinate is not finite.
  ParsedMesh finish(bool binary = false);

 private:
  const Source& source_;
  ParsedMesh mesh_;
  std::vector<double> xyz_;
  std::set<std::string> dropped_;
};

/// The polygons that a file of a mesh holds: the elements of a plane or surface mesh with all its
/// nodes, or what bounds a volume mesh, seen from outside counter-clockwise, with the nodes there.
class WrittenSurface {
 public:
  /// What they refer to has to outlive this; details may be null.
  WrittenSurface(const Mesh& mesh, const FormatDetails* details);

  Index node_count() const { return static_cast<Index>(nodes_.size()); }
  Vec3 node(Index i) const { return space_.node(nodes_[static_cast<std::size_t>(i)]); }
  const std::vector<FileCorners>& faces() const { return faces_; }
  /// Against which the triangle or quadrilateral goes round; a unit vector, or zero for one without
  /// area.
  Vec3 normal(const FileCorners& corners) const;

  /// The faces of each marker of a volume mesh, one after the other, and of none; else one group.
  struct Group {
    std::string name;  ///< empty: of a plane or surface mesh
    std::size_t first, count;
  };
  const std::vector<Group>& groups() const { return groups_; }

 private:
  void add_boundary(const Topology& topology);

  MeshInSpace space_;
  bool plane_;
  std::vector<Index> nodes_;
  std::vector<FileCorners> faces_;
  std::vector<Group> groups_;
};

/// Sentences about what a surface format cannot hold. keeps_groups: it has parts with names.
std::vector<std::string> lost_in_surface(const Mesh& mesh, bool keeps_groups = false);

}  // namespace winslow::io::surface
