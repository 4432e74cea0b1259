#pragma once

#include "core/mesh/mesh_data.h"
#include "io/format/mesh_file.h"
#include "io/text/source.h"

namespace winslow::io {

/// Where in the file each thing stands (byte offsets), so that an error found later can name it.
struct SourceMap {
  std::vector<std::size_t> nodes;
  std::vector<std::size_t> elements;
  std::vector<std::vector<std::size_t>> marker_edges;  ///< as MeshData::markers[m].faces
};

/// What a reader of one format returns.
struct ParsedMesh {
  MeshData data;
  SourceMap where;
  /// Never null; a format that has more to keep makes one of its own kind.
  std::shared_ptr<FormatDetails> details = std::make_shared<FormatDetails>();
  std::vector<std::string> warnings;  ///< without the file's name
};

/// Sets the nodes' coordinates from x, y, z triples: x and y where z is constant, in-plane
/// coordinates (and a warning that says so) in any other plane. Throws InputError for one that is
/// not finite and for nodes that lie in no plane. Distances below 1e-9 of the extent count as
/// noise; where the nodes were in space is kept in `details` and written back.
void set_planar_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh);

/// Sets the nodes' coordinates in space, of a surface or volume mesh. Throws InputError for one
/// that is not finite.
void set_space_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh);
/// set_space_nodes() if the elements have three dimensions or the nodes lie in no plane; else
/// set_planar_nodes(). The elements must be known by now.
void set_nodes(const Source& source, const std::vector<double>& xyz, ParsedMesh& mesh);

/// Turns all elements of a mesh in another plane than z = constant if they go round clockwise
/// there: the file shows the plane from behind. Details say so, for the way back.
void turn_to_viewer(ParsedMesh& mesh);

/// Throws InputError "... not finite" at the first node that has a NaN or an infinity.
void check_finite(const Source& source, const ParsedMesh& mesh);

}  // namespace winslow::io
