#pragma once

#include <filesystem>
#include <string>
#include <variant>

/// The studio's first page and what outlives the studio. Carried out by the workbench.
namespace winslow::gui::action {

/// The page of recent and bundled meshes comes, or goes.
struct ShowWelcome {};
struct ClearRecent {};
/// Puts the keyboard into a field of the column on the left, which comes up and unfolds for it. A
/// name that ends in "/" is that of the section of such fields: it unfolds.
struct EditField {
  std::string field;  ///< id of the widget: "motion/rotate"
};
/// Puts a text where other programs can paste it.
struct CopyText {
  std::string text;
};
struct RestoreSession {
  std::filesystem::path folder;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
};
struct DiscardSession {
  std::filesystem::path folder;
};

}  // namespace winslow::gui::action

namespace winslow::gui {

using ShellAction = std::variant<action::ShowWelcome, action::ClearRecent, action::EditField,
                                 action::CopyText, action::RestoreSession, action::DiscardSession>;

}  // namespace winslow::gui
