#pragma once

#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <future>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

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

/// What the session's work on files has in common.

/// `work`, whose failure is text rather than an exception. Running out of memory on a huge file is
/// an error like another.
template <class Work>
std::string error_of(Work&& work) {
  try {
    work();
    return {};
  } catch (const std::bad_alloc&) {
    return "There is not enough memory.";
  } catch (const std::exception& error) {
    return error.what();
  }
}

inline bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

}  // namespace winslow::gui
