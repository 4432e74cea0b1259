#pragma once

#include <set>

#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"
#include "io/format/mesh_in_space.h"

/// Formats for surfaces in space: vertices and faces, no markers. (OpenMesh reads and writes them
/// only in single precision, so only the tests use it, as a check.)
namespace winslow::io::surface {

extern const MeshFormat obj_format, off_format, ply_format, stl_format;

/// Collects the vertices and faces that a reader finds.
class Builder {
 public:
  explicit Builder(const Source& source) : source_(source) {
    mesh_.details = std::make_shared<FormatDetails>();
  }
  ParsedMesh& mesh() { return mesh_; }
  /// Records content that a mesh cannot hold: "colours", "groups", ... One warning for each.
  void drops(const std::string& what) { dropped_.insert(what); }
  Index vertices() const { return static_cast<Index>(xyz_.size() / 3); }

  void add_vertex(double x, double y, double z, std::size_t offset);
  /// Throws InputError unless a face may have so many corners.
  void require_corners(std::size_t count, std::size_t offset) const;
  /// Throws InputError as require_corners(). Its vertices may be added later.
  void add_face(std::span<const Index> corners, std::size_t offset);
  /// Throws InputError if there is no face, or if a coordinate is not finite.
  ParsedMesh finish(bool binary = false);

 private:
  const Source& source_;
  ParsedMesh mesh_;
  std::vector<double> xyz_;
  std::set<std::string> dropped_;
  bool polygons_ = false;  // a face has more than four corners
};

/// The polygons to write: the elements of a plane or surface mesh with all its nodes, or the
/// boundary faces of a volume mesh, counter-clockwise seen from outside, with their nodes.
class WrittenSurface {
 public:
  /// The arguments must outlive this object; details may be null.
  WrittenSurface(const Mesh& mesh, const FormatDetails* details);

  Index node_count() const { return static_cast<Index>(nodes_.size()); }
  Vec3 node(Index i) const { return space_.node(nodes_[static_cast<std::size_t>(i)]); }
  const std::vector<FileCorners>& faces() const { return faces_; }
  /// Unit normal against which the face is counter-clockwise; zero for a face without area.
  Vec3 normal(const FileCorners& corners) const;

  /// Consecutive faces of a marker of a volume mesh, or of no marker; for other meshes all faces.
  struct Group {
    std::string name;  ///< empty for a plane or surface mesh
    std::size_t first, count;
  };
  const std::vector<Group>& groups() const { return groups_; }

 private:
  void add_boundary(const Topology& topology);
  Vec3 normal_of_polygon(const FileCorners& corners) const;

  MeshInSpace space_;
  bool plane_;
  std::vector<Index> nodes_;
  std::vector<FileCorners> faces_;
  std::vector<Group> groups_;
};

/// Sentences about content that a surface format cannot hold. keeps_groups: it has named parts of
/// the boundary of a volume mesh; keeps_regions: and of a surface.
std::vector<std::string> lost_in_surface(const Mesh& mesh, bool keeps_groups = false,
                                         bool keeps_regions = false);

}  // namespace winslow::io::surface

namespace winslow::io {

/// What is in a mesh file.
struct MeshCounts {
  Index nodes = 0, elements = 0;
  std::size_t markers = 0;
};

/// What write_mesh() puts into a file of that name: of a volume mesh in a surface format only the
/// boundary, of quadrilaterals in STL two triangles each, of markers that come from no file none.
///
///     const MeshCounts counts = written_counts("wing.stl", file.mesh, file.details.get());
MeshCounts written_counts(const std::filesystem::path& path, const Mesh& mesh,
                          const FormatDetails* details);

}  // namespace winslow::io
