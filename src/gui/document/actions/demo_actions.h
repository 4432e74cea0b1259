#pragma once

#include <string>
#include <variant>

/// Guided demos. Carried out by DemoPlayer through the workbench.
namespace winslow::gui::action {

struct StartDemo {
  std::string id;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
};
/// To the next step or, with -1, back to the one before.
struct StepDemo {
  int by = 1;
};
/// Goes on by itself, or waits at each step.
struct PlayDemo {
  bool automatic = true;
};
struct EndDemo {};

}  // namespace winslow::gui::action

namespace winslow::gui {

using DemoAction =
    std::variant<action::StartDemo, action::StepDemo, action::PlayDemo, action::EndDemo>;

}  // namespace winslow::gui
