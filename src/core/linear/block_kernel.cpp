#include "core/linear/block_kernel.h"

#include "core/simd/instruction_set.h"

#define WINSLOW_KERNEL portable_blocks
#include "core/linear/block_kernel.inc"

namespace winslow {

#ifdef WINSLOW_HAS_AVX2
extern const BlockKernel avx2_blocks;
#endif

const BlockKernel& portable_block_kernel() { return portable_blocks; }

const BlockKernel* avx2_block_kernel() {
#ifdef WINSLOW_HAS_AVX2
  if (has_avx2()) return &avx2_blocks;
#endif
  return nullptr;
}

const BlockKernel& block_kernel() {
  const BlockKernel* best = avx2_block_kernel();
  return best ? *best : portable_blocks;
}

}  // namespace winslow
