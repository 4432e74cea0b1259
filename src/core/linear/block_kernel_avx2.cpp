// Compiled with -mavx2: must not include headers whose inline functions other files could link.
#ifdef WINSLOW_HAS_AVX2
#define WINSLOW_KERNEL avx2_blocks
#include "core/linear/block_kernel.inc"
#endif
