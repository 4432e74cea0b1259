#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace winslow::test {

/// Waits as long as no healthy run needs.
inline bool wait_until(const std::function<bool()>& done) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  while (std::chrono::steady_clock::now() < limit) {
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace winslow::test
