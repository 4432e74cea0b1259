#pragma once

#include <variant>

namespace winslow::gui {

/// Hands an action to the object that carries it out: to its function void on(const A&). An action
/// without such a function does not compile, and neither does a handler that takes whatever it is
/// given: it would swallow actions that nobody handles.
class Dispatch {
  struct NoAction {};
  // By its exact type: an action must not reach a function through a conversion.
  template <class Handler, class A>
  static constexpr bool takes = requires {
    static_cast<void (Handler::*)(const A&)>(&Handler::on);
  };
  template <class Handler>
  static constexpr bool takes_anything = requires(Handler& handler, const NoAction& nothing) {
    handler.on(nothing);
  };
  template <class Handler, class... As>
  static constexpr bool takes_all(const std::variant<As...>* /*actions*/) {
    return (takes<Handler, As> && ...) && !takes_anything<Handler>;
  }

 public:
  template <class Handler, class... As>
  static void to(Handler& handler, const std::variant<As...>& action) {
    static_assert(!takes_anything<Handler>, "on() takes what is no action at all");
    static_assert((takes<Handler, As> && ...), "an action that the handler has no on() for");
    std::visit([&handler](const auto& a) { handler.on(a); }, action);
  }

  /// `Handler` has a function on() for every alternative of the variant `Actions`, and for nothing
  /// else.
  template <class Handler, class Actions>
  static constexpr bool complete() {
    return takes_all<Handler>(static_cast<const Actions*>(nullptr));
  }
};

}  // namespace winslow::gui
