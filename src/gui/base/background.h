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

/// Runs one task at a time on a separate thread; its result is collected by polling.
template <class Result>
class Background {
 public:
  bool busy() const { return future_.valid(); }

  /// Must not be busy.
  void start(std::function<Result()> work) {
    future_ = std::async(std::launch::async, std::move(work));
  }

  /// The result, once, when it is available; never waits. `work` must not throw.
  std::optional<Result> poll() {
    if (!future_.valid() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return std::nullopt;
    return future_.get();
  }

 private:
  std::future<Result> future_;
};

/// Helpers for work on files.

/// Runs `work` and returns the text of its exception; empty: none. Lack of memory for a huge file
/// is treated like any other error.
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
