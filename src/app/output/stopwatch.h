#pragma once

#include <chrono>
#include <cstdint>

namespace winslow::app {

/// Wall-clock seconds since it was made or last restarted.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// The seconds so far; counts from zero again.
  double lap() {
    const double s = seconds();
    start_ = std::chrono::steady_clock::now();
    return s;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Where the time of a run went.
struct Timings {
  double load = 0, solve = 0, save = 0, total = 0;  ///< seconds
};

/// Largest resident set of this process so far, bytes.
std::int64_t peak_memory_bytes();

}  // namespace winslow::app
