#pragma once

#include <filesystem>
#include <variant>

/// The studio's first page and what outlives the studio. Carried out by the workbench.
namespace winslow::gui::action {

/// The page of recent and bundled meshes comes, or goes.
struct ShowWelcome {};
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

using ShellAction = std::variant<action::ShowWelcome, action::ClearRecent, action::RestoreSession,
                                 action::DiscardSession>;

}  // namespace winslow::gui
