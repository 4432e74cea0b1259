#include "core/formulation/tetrahedron_kernel.h"

#include "core/simd/instruction_set.h"

#define WINSLOW_KERNEL portable_tetrahedra
#include "core/formulation/tetrahedron_kernel.inc"

namespace winslow::distortion {

#ifdef WINSLOW_HAS_AVX2
extern const TetrahedronKernel avx2_tetrahedra;
#endif

const TetrahedronKernel& portable_tetrahedron_kernel() { return portable_tetrahedra; }

const TetrahedronKernel* avx2_tetrahedron_kernel() {
#ifdef WINSLOW_HAS_AVX2
  if (has_avx2()) return &avx2_tetrahedra;
#endif
  return nullptr;
}

const TetrahedronKernel& tetrahedron_kernel() {
  const TetrahedronKernel* best = avx2_tetrahedron_kernel();
  return best ? *best : portable_tetrahedra;
}

template <>
const TetrahedronKernel& fastest_kernel<3>() {
  return tetrahedron_kernel();
}

}  // namespace winslow::distortion
