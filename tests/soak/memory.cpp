#include "memory.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "support/sanitizers.h"

#ifdef WINSLOW_ADDRESS_SANITIZER
/// Declared here: not every compiler brings the header.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
extern "C" void __sanitizer_purge_allocator();
#endif

namespace winslow::gui::test {

namespace {

std::size_t allocated() {
#ifdef WINSLOW_ADDRESS_SANITIZER
  return __sanitizer_get_current_allocated_bytes();
#else
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
#endif
}

/// What is free goes back from the allocator's reserve to the system.
void purge() {
#ifdef WINSLOW_ADDRESS_SANITIZER
  __sanitizer_purge_allocator();
#else
  malloc_trim(0);
#endif
}

}  // namespace

Memory memory_now() {
  purge();
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  file >> total >> resident;
  return {allocated(), resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE))};
}

std::ptrdiff_t MemoryWatch::growth(std::size_t Memory::*of) const {
  if (samples_.size() < 12) return 0;
  const auto median = [&](std::size_t quarter) {
    std::vector<std::size_t> part;
    for (std::size_t i = quarter * samples_.size() / 4; i < (quarter + 1) * samples_.size() / 4;
         ++i)
      part.push_back(samples_[i].*of);
    std::sort(part.begin(), part.end());
    return static_cast<std::ptrdiff_t>(part[part.size() / 2]);
  };
  return median(3) - median(1);
}

}  // namespace winslow::gui::test
