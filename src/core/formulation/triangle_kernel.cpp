#include "core/formulation/triangle_kernel.h"

#include "core/simd/instruction_set.h"

#define WINSLOW_KERNEL portable_kernel
#include "core/formulation/triangle_kernel.inc"

namespace winslow::distortion {

#ifdef WINSLOW_HAS_AVX2
extern const TriangleKernel avx2_kernel;
#endif

const TriangleKernel& portable_triangle_kernel() { return portable_kernel; }

const TriangleKernel* avx2_triangle_kernel() {
#ifdef WINSLOW_HAS_AVX2
  if (has_avx2()) return &avx2_kernel;
#endif
  return nullptr;
}

const TriangleKernel& triangle_kernel() {
  const TriangleKernel* best = avx2_triangle_kernel();
  return best ? *best : portable_kernel;
}

template <>
const TriangleKernel& fastest_kernel<2>() {
  return triangle_kernel();
}

}  // namespace winslow::distortion
