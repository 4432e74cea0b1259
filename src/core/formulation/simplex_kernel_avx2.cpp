// Compiled with -mavx2: must not include headers whose inline functions other files could link.
#ifdef WINSLOW_HAS_AVX2
#define WINSLOW_KERNEL avx2_triangles
#include "core/formulation/triangle_kernel.inc"
#undef WINSLOW_KERNEL
#define WINSLOW_KERNEL avx2_tetrahedra
#include "core/formulation/tetrahedron_kernel.inc"
#endif
