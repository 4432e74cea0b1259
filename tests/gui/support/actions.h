#pragma once

#include <variant>

#include "gui/document/actions/actions.h"

namespace winslow::gui::test {

/// The action is an A, in whichever of the groups that are variants themselves.
template <class A, class T>
bool holds(const T&) {
  return std::is_same_v<A, T>;
}
template <class A, class... As>
bool holds(const std::variant<As...>& action) {
  return std::visit([](const auto& a) { return holds<A>(a); }, action);
}

}  // namespace winslow::gui::test
