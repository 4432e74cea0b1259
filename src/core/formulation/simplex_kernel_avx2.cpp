// Compiled with -mavx2: includes nothing whose inline functions another file could end up with.
#ifdef WINSLOW_HAS_AVX2
#define WINSLOW_KERNEL avx2_triangles
#include "core/formulation/triangle_kernel.inc"
#undef WINSLOW_KERNEL
#define WINSLOW_KERNEL avx2_tetrahedra
#include "core/formulation/tetrahedron_kernel.inc"
#endif
