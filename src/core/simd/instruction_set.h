#pragma once

namespace winslow {

/// Whether this program has AVX2 versions of its kernels and the processor runs them.
inline bool has_avx2() {
#ifdef WINSLOW_HAS_AVX2
  static const bool runs = __builtin_cpu_supports("avx2") != 0;
  return runs;
#else
  return false;
#endif
}

}  // namespace winslow
