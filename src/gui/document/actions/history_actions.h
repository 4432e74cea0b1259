#pragma once

#include <cstddef>
#include <filesystem>
#include <variant>

#include "core/command/command.h"

/// Past commands: going back to them and changing them. Carried out by HistoryEditor.
namespace winslow::gui::action {

struct Undo {};
struct Redo {};
struct GoToStep {
  std::size_t position = 0;
};
/// Another command in the place of one that was carried out; those after it are run again.
struct EditStep {
  std::size_t position = 0;
  Command command;
};
/// Takes a command out; those after it are run again.
struct DeleteStep {
  std::size_t position = 0;
};
/// Puts a history back that an edit replaced; the present one is kept in its place.
struct BringBack {
  std::size_t kept = 0;  ///< index into Document::kept()
};
/// Applies the commands of a recipe to the open mesh, one after the other.
struct ReplayRecipe {
  std::filesystem::path path;
};

}  // namespace winslow::gui::action

namespace winslow::gui {

using HistoryAction = std::variant<action::Undo, action::Redo, action::GoToStep, action::EditStep,
                                   action::DeleteStep, action::BringBack, action::ReplayRecipe>;

}  // namespace winslow::gui
