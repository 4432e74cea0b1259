#pragma once

#include <filesystem>

#include "core/mesh/topology.h"

namespace winslow::gui {

/// Files that belong together in a dialog's filter: "Gmsh" has ".msh".
struct FileKind {
  std::string label;
  std::vector<std::string> extensions;  ///< in lower case, with their dots; empty: all files
};

/// What a file dialog is open for.
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
  step_reference  ///< of a step that is being edited
};

/// What a file dialog says and accepts. TO ADD A PURPOSE, add it to dialog_of in file_kinds.cpp and
/// say in FileDialog::choose which action it stands for.
struct DialogKind {
  std::string title;
  std::string button;
  bool saves = true;
  /// The first stands for all that can be opened or written; when saving, the others are single
  /// formats.
  std::vector<FileKind> kinds;
  std::string default_extension;  ///< added to a name without one; empty: none is
  bool folders = false;           ///< a name without an extension stands for a folder to be made
};
/// kind: of the mesh that is to be written.
DialogKind dialog_of(FilePurpose purpose, MeshKind kind = MeshKind::plane);

/// The name is of this kind.
bool matches(const FileKind& kind, const std::string& name);
/// In lower case, with its dot.
std::string extension_of(const std::string& name);
std::string lower_case(std::string text);

/// By what it is seen that a file was replaced or written to.
struct FileStamp {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  ///< of the last change of its content
  bool operator==(const FileStamp&) const = default;
};

/// Empty if there is no such file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

}  // namespace winslow::gui
