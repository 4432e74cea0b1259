#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "gui/files/file_kinds.h"

/// Dialogs that come up. Carried out by Dialogs.
namespace winslow::gui::action {

struct ShowFileDialog {
  FilePurpose purpose = FilePurpose::open_mesh;
  std::string extension = {};  ///< ".vtu": of the name to start with; empty: as it is
};
struct ShowPictureDialog {};
struct ShowRecordDialog {
  std::optional<std::size_t> step;  ///< as StartRecording
};
struct ShowStepEditor {
  std::size_t position = 0;
};
struct ShowHelp {};
struct ShowPalette {};
struct ShowAbout {};

}  // namespace winslow::gui::action

namespace winslow::gui {

using DialogAction =
    std::variant<action::ShowFileDialog, action::ShowPictureDialog, action::ShowRecordDialog,
                 action::ShowStepEditor, action::ShowHelp, action::ShowPalette, action::ShowAbout>;

}  // namespace winslow::gui
