#include "core/formulation/simplex_kernel.h"

#include "core/simd/instruction_set.h"

#define WINSLOW_KERNEL portable_triangles
#include "core/formulation/triangle_kernel.inc"
#undef WINSLOW_KERNEL
#define WINSLOW_KERNEL portable_tetrahedra
#include "core/formulation/tetrahedron_kernel.inc"

namespace winslow::distortion {

template <>
const TriangleKernel& portable_kernel<2>() {
  return portable_triangles;
}
template <>
const TetrahedronKernel& portable_kernel<3>() {
  return portable_tetrahedra;
}

#ifdef WINSLOW_HAS_AVX2
extern const TriangleKernel avx2_triangles;
extern const TetrahedronKernel avx2_tetrahedra;
template <>
const TriangleKernel* avx2_kernel<2>() {
  return has_avx2() ? &avx2_triangles : nullptr;
}
template <>
const TetrahedronKernel* avx2_kernel<3>() {
  return has_avx2() ? &avx2_tetrahedra : nullptr;
}
#else
template <>
const TriangleKernel* avx2_kernel<2>() {
  return nullptr;
}
template <>
const TetrahedronKernel* avx2_kernel<3>() {
  return nullptr;
}
#endif

template <int D>
const SimplexKernel<D>& fastest_kernel() {
  const SimplexKernel<D>* best = avx2_kernel<D>();
  return best ? *best : portable_kernel<D>();
}
template const TriangleKernel& fastest_kernel<2>();
template const TetrahedronKernel& fastest_kernel<3>();

}  // namespace winslow::distortion
