#include "memory.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace winslow::gui::test {

std::size_t resident_memory() {
  // What is free must not count: how much of it is kept back is a matter of chance.
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::ptrdiff_t MemoryWatch::growth() const {
  if (samples_.size() < 12) return 0;
  const auto median = [&](std::size_t quarter) {
    const auto begin =
        samples_.begin() + static_cast<std::ptrdiff_t>(quarter * samples_.size() / 4);
    const auto end =
        samples_.begin() + static_cast<std::ptrdiff_t>((quarter + 1) * samples_.size() / 4);
    std::vector<std::size_t> part(begin, end);
    std::sort(part.begin(), part.end());
    return static_cast<std::ptrdiff_t>(part[part.size() / 2]);
  };
  return median(3) - median(1);
}

}  // namespace winslow::gui::test
