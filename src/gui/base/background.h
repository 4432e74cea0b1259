#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>

namespace winslow::gui {

/// One piece of work at a time on a thread of its own, whose outcome is collected by polling.
template <class Result>
class Background {
 public:
  bool busy() const { return future_.valid(); }

  /// Must not be busy.
  void start(std::function<Result()> work) {
    future_ = std::async(std::launch::async, std::move(work));
  }

  /// The outcome, once, as soon as it is there; never waits. `work` must not throw.
  std::optional<Result> poll() {
    if (!future_.valid() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return std::nullopt;
    return future_.get();
  }

 private:
  std::future<Result> future_;
};

}  // namespace winslow::gui
