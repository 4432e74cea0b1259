#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "gui/files/file_kinds.h"

/// Dialogs, pages and what outlives the studio. Carried out by the workbench.
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
struct ShowWelcome {};
struct ShowAbout {};
struct ClearRecent {};
struct RestoreSession {
  std::filesystem::path folder;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
};
struct DiscardSession {
  std::filesystem::path folder;
};

}  // namespace winslow::gui::action

namespace winslow::gui {

using ShellAction =
    std::variant<action::ShowFileDialog, action::ShowPictureDialog, action::ShowRecordDialog,
                 action::ShowStepEditor, action::ShowHelp, action::ShowPalette, action::ShowWelcome,
                 action::ShowAbout, action::ClearRecent, action::RestoreSession,
                 action::DiscardSession>;

}  // namespace winslow::gui
