#pragma once

#include <variant>

/// Answers to what the studio says. Carried out by MessageBoard.
namespace winslow::gui::action {

struct DismissPrompt {};
struct DismissBanner {};

}  // namespace winslow::gui::action

namespace winslow::gui {

using MessageAction = std::variant<action::DismissPrompt, action::DismissBanner>;

}  // namespace winslow::gui
