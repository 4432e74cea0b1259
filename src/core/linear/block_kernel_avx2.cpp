// Compiled with -mavx2: includes nothing whose inline functions another file could end up with.
#ifdef WINSLOW_HAS_AVX2
#define WINSLOW_KERNEL avx2_blocks
#include "core/linear/block_kernel.inc"
#endif
