#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "core/types.h"

/// Opening, saving and exporting. Carried out by Files.
namespace winslow::gui::action {

struct OpenMesh {
  std::filesystem::path path;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
  int zone = 0;                  ///< of a file of several zones; 0: the first
};
struct SaveMesh {
  std::filesystem::path path;   ///< empty: where the mesh came from
  bool overwrite = false;       ///< false: ask if the file exists
  bool allow_inverted = false;  ///< false: ask if the mesh has inverted elements
  /// Go on with what Files::ask_to_save() was called for, once the mesh is saved.
  bool proceed = false;
};
/// Closes the open mesh.
struct CloseMesh {
  bool discard_changes = false;  ///< false: ask if it has unsaved changes
};
/// Writes a copy: the open mesh stays the one it is, saved or not.
struct ExportMesh {
  std::filesystem::path path;
  bool overwrite = false;
};
/// Writes markers as curves (io/tables/boundary_file.h).
struct ExportMarkers {
  std::filesystem::path path;
  std::vector<Index> markers;  ///< empty: those selected or, without a selection, all
  bool overwrite = false;
};
struct ExportRecipe {
  std::filesystem::path path;
  bool overwrite = false;
};
/// Writes the iterations that the convergence plot shows as CSV.
struct ExportConvergence {
  std::filesystem::path path;
  bool overwrite = false;
};
struct Quit {
  bool discard_changes = false;
};

}  // namespace winslow::gui::action

namespace winslow::gui {

using FileAction = std::variant<action::OpenMesh, action::SaveMesh, action::CloseMesh,
                                action::ExportMesh, action::ExportMarkers, action::ExportRecipe,
                                action::ExportConvergence, action::Quit>;

}  // namespace winslow::gui
