#pragma once

#include <filesystem>

#include "core/mesh/topology.h"

namespace winslow::gui {

/// An entry of a file dialog's filter: "Gmsh" has ".msh".
struct FileKind {
  std::string label;
  std::vector<std::string> extensions;  ///< in lower case, with dots; empty: all files
};

/// The purpose of a file dialog.
enum class FilePurpose {
  open_mesh,
  save_mesh,
  export_mesh,
  export_markers,
  export_recipe,
  replay_recipe,
  export_convergence,
  picture,
  recording,
  reference,
  displacements,  ///< of single nodes
  positions,      ///< of single nodes, after the motion
  step_reference  ///< for a step that is being edited
};

/// The texts and file kinds of a file dialog. TO ADD A PURPOSE, add it to dialog_of in
/// file_kinds.cpp and its action to FileDialog::choose.
struct DialogKind {
  std::string title;
  std::string button;
  bool saves = true;
  /// The first contains all files that can be opened or written; when saving, the others are single
  /// formats.
  std::vector<FileKind> kinds;
  std::string default_extension;  ///< added to a name without one; empty: none
  bool folders = false;           ///< a name without an extension means a new folder
};
/// kind: of the mesh to be written.
DialogKind dialog_of(FilePurpose purpose, MeshKind kind = MeshKind::plane);

/// True if the name matches this kind.
bool matches(const FileKind& kind, const std::string& name);
/// Extension in lower case, with its dot.
std::string extension_of(const std::string& name);
std::string lower_case(std::string text);

/// Identifies the state of a file: it changes when the file is replaced or written to.
struct FileStamp {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  ///< of the last change of its content
  bool operator==(const FileStamp&) const = default;
};

/// Stamp of a file; empty if it does not exist.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

}  // namespace winslow::gui
