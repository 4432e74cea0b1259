#pragma once

#include <ostream>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"

/// Formats made for surfaces in space: vertices and faces, no markers. (OpenMesh reads and writes
/// them in single precision only, so it serves here as the check in the tests, not as the reader.)
namespace winslow::io::surface {

extern const MeshFormat obj_format, off_format, ply_format, stl_format;

ParsedMesh read_obj(Source& source);
ParsedMesh read_off(Source& source);
ParsedMesh read_ply(Source& source);
/// Corners at exactly the same place become one node, in the order in which they first appear.
ParsedMesh read_stl(Source& source);

std::vector<std::string> write_obj(std::ostream& out, const Mesh& mesh,
                                   const FormatDetails* source);
std::vector<std::string> write_off(std::ostream& out, const Mesh& mesh,
                                   const FormatDetails* source);
std::vector<std::string> write_ply(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                                   bool binary);
/// Quadrilaterals become two triangles each; binary STL holds single precision.
std::vector<std::string> write_stl(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                                   bool binary);

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
  /// Throws InputError if there is no face, or if a coordinate is not finite or not planar.
  ParsedMesh finish(bool binary = false);

 private:
  const Source& source_;
  ParsedMesh mesh_;
  std::vector<double> xyz_;
  std::set<std::string> dropped_;
};

/// Sentences about what a surface format cannot hold.
std::vector<std::string> lost_in_surface(const Mesh& mesh);

}  // namespace winslow::io::surface
