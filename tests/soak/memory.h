#pragma once

#include <cstddef>
#include <vector>

namespace winslow::gui::test {

/// Memory of this process, bytes.
struct Memory {
  std::size_t allocated = 0;  ///< by new and malloc, and not given back by the program
  std::size_t resident = 0;   ///< with what the allocator keeps for later
};
Memory memory_now();

/// Samples of memory, taken where it should be the same each time.
class MemoryWatch {
 public:
  void sample() { samples_.push_back(memory_now()); }
  std::size_t count() const { return samples_.size(); }
  Memory first() const { return samples_.empty() ? Memory{} : samples_.front(); }
  Memory last() const { return samples_.empty() ? Memory{} : samples_.back(); }
  /// How far the median of the last quarter of the samples lies above that of the second quarter,
  /// in bytes: caches have filled by then. 0 with fewer than 12 samples.
  std::ptrdiff_t growth(std::size_t Memory::*of) const;
  const std::vector<Memory>& samples() const { return samples_; }

 private:
  std::vector<Memory> samples_;
};

}  // namespace winslow::gui::test
