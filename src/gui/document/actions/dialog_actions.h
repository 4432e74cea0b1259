#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "gui/document/selection/picked_place.h"
#include "gui/files/file_kinds.h"

/// Dialogs that come up. Carried out by Dialogs.
namespace winslow::gui::action {

struct ShowFileDialog {
  FilePurpose purpose = FilePurpose::open_mesh;
  std::string extension = {};  ///< ".vtu": of the name to start with; empty: as it is
  bool proceed = false;        ///< of a mesh to be saved: as action::SaveMesh
};
struct ShowPictureDialog {};
struct ShowRecordDialog {
  std::optional<std::size_t> step;  ///< as StartRecording
};
struct ShowStepEditor {
  std::size_t position = 0;
};
/// The surface in a file, for nodes to slide on in the step that is being edited.
struct ChooseStepReference {
  std::filesystem::path file;
};
/// The menu of a right click, beside the mouse.
struct ShowContextMenu {
  PickedPlace place;
};
struct ShowHelp {};
struct ShowPalette {};
struct ShowAbout {};

}  // namespace winslow::gui::action

namespace winslow::gui {

using DialogAction =
    std::variant<action::ShowFileDialog, action::ShowPictureDialog, action::ShowRecordDialog,
                 action::ShowStepEditor, action::ChooseStepReference, action::ShowContextMenu,
                 action::ShowHelp, action::ShowPalette, action::ShowAbout>;

}  // namespace winslow::gui
