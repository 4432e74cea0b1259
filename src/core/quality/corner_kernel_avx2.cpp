// Compiled with -mavx2: includes nothing whose inline functions another file could end up with.
#ifdef WINSLOW_HAS_AVX2
#define WINSLOW_KERNEL summarise_corners_avx2
#include "core/quality/corner_kernel.inc"
#endif
