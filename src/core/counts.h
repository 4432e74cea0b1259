#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "core/error.h"

/// Counts of what a mesh or a matrix consists of, which an Index numbers: up to 2^31 - 1. Products
/// of such counts with sizes of blocks are 64-bit numbers everywhere.
namespace winslow {

[[noreturn]] inline void refuse_count(std::size_t count, std::string_view what) {
  throw UsageError(std::to_string(count) + " " + std::string(what) + ", expected at most " +
                   std::to_string(std::numeric_limits<Index>::max()) +
                   ": the mesh is too large, divide it");
}

/// A number of items as an Index. Throws UsageError if an Index cannot number them. what: the
/// items, as "corners of elements".
inline Index index_count(std::size_t count, std::string_view what) {
  if (count > at(std::numeric_limits<Index>::max())) refuse_count(count, what);
  return static_cast<Index>(count);
}

/// Turns counts into offsets: each becomes the sum of those up to it. what: as for index_count(),
/// which checks the sum of all.
inline void add_up(std::span<Index> counts, std::string_view what) {
  std::size_t sum = 0;
  for (Index& count : counts) {
    sum += at(count);
    count = index_count(sum, what);
  }
}

}  // namespace winslow
