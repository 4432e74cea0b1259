#pragma once

#include <cstddef>
#include <vector>

namespace winslow::gui::test {

/// Memory of this process that is in use now, in bytes. 0 where the system does not say.
std::size_t resident_memory();

/// Samples of memory in use, taken where it should be the same each time.
class MemoryWatch {
 public:
  void sample() { samples_.push_back(resident_memory()); }
  std::size_t count() const { return samples_.size(); }
  std::size_t first() const { return samples_.empty() ? 0 : samples_.front(); }
  std::size_t last() const { return samples_.empty() ? 0 : samples_.back(); }
  /// How far the median of the last quarter of the samples lies above that of the second quarter,
  /// in bytes: caches have filled by then. 0 with fewer than 12 samples.
  std::ptrdiff_t growth() const;

 private:
  std::vector<std::size_t> samples_;
};

}  // namespace winslow::gui::test
