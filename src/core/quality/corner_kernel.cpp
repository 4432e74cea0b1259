#include "core/quality/corner_kernel.h"

#include "core/simd/instruction_set.h"

#define WINSLOW_KERNEL summarise_corners
#include "core/quality/corner_kernel.inc"

namespace winslow {

#ifdef WINSLOW_HAS_AVX2
CornerSummary summarise_corners_avx2(const CornerData& data, Index begin, Index end);
#endif

CornerKernel portable_corner_kernel() { return summarise_corners; }

CornerKernel avx2_corner_kernel() {
#ifdef WINSLOW_HAS_AVX2
  if (has_avx2()) return summarise_corners_avx2;
#endif
  return nullptr;
}

}  // namespace winslow
