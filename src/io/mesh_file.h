#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

/// Reading and writing meshes: the one header that the rest of the program needs.
namespace winslow::io {

enum class Format { su2, gmsh, vtk, vtu, obj, off, ply, stl };

/// Name as the user types it: "su2", "msh", "vtk", ...
std::string_view format_name(Format format);
/// Formats in which markers survive.
bool keeps_markers(Format format);

/// What a format can hold beyond a Mesh (version, entity and node tags, order of blocks, ...):
/// kept from reading to writing so that a file in the same format comes back unchanged but for the
/// coordinates. Each format derives its own.
struct FormatDetails {
  virtual ~FormatDetails() = default;
  std::optional<Format> format;  ///< of the source
  bool binary = false;           ///< the source was binary
  std::vector<double> plane_z;   ///< z of each node, or one for all; empty: 0
};

/// A mesh read from a file.
struct MeshFile {
  Mesh mesh;
  Format format = Format::su2;
  std::shared_ptr<const FormatDetails> details;  ///< null for a mesh that came from no file
  std::vector<std::string> warnings;             ///< sentences; each names the file
};

/// Reads a mesh. The format is found by content (a warning, if the extension says otherwise), or by
/// extension where the content tells nothing. Throws InputError "FILE:LINE: ..." / "FILE: byte N:
/// ...": never crashes on any content, and never allocates more than the file's size justifies.
MeshFile read_mesh(const std::filesystem::path& path);

struct WriteOptions {
  std::optional<Format> format;  ///< default: by the extension of the path
  bool binary = false;           ///< Gmsh, VTK, VTU, PLY, STL: binary instead of ASCII
  bool keep_encoding = true;     ///< binary also where the source is binary and of this format
  std::string gmsh_version;      ///< "2.2" or "4.1"; empty: that of the source, else 4.1
};

/// Writes a mesh to a temporary name beside `path` and renames it. `details` of another format, or
/// null, are ignored as far as they do not apply. Returns warnings (markers lost, ...).
/// Throws OutputError (the target is then as it was) and UsageError (unknown extension).
std::vector<std::string> write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                                    const FormatDetails* details, const WriteOptions& options = {});

}  // namespace winslow::io
