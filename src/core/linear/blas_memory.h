#pragma once

#include <atomic>
#include <cstdlib>

namespace winslow {

/// Whether a call of BLAS will find memory to work in. OpenBLAS takes a buffer of 128 MB at its
/// first call and keeps it; where there is none to be had (a limit of the address space) it asks
/// again and again, for ever. So ask before it does.
inline bool blas_has_memory() {
  static std::atomic<bool> had = false;
  constexpr std::size_t buffer = std::size_t{160} << 20;
  if (had) return true;
  void* volatile const probe = std::malloc(buffer);  // volatile: the compiler may not leave it out
  had = probe != nullptr;
  std::free(probe);
  return had;
}

}  // namespace winslow
