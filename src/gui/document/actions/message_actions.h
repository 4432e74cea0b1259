#pragma once

#include <string>
#include <variant>

/// Answers to what the studio says. Carried out by MessageBoard.
namespace winslow::gui::action {

struct DismissPrompt {};
struct DismissBanner {};
/// A passing remark on what the user has just tried.
struct Remark {
  std::string text;
};

}  // namespace winslow::gui::action

namespace winslow::gui {

using MessageAction = std::variant<action::DismissPrompt, action::DismissBanner, action::Remark>;

}  // namespace winslow::gui
