#pragma once

#include "core/index.h"

/// The loop of check_validity() over plane meshes, four corners at a time, compiled for several
/// instruction sets. Every version gives the same bits as Corner.
namespace winslow {

struct CornerData {
  const double* x = nullptr;       ///< #nodes by 2
  const Index* offsets = nullptr;  ///< #elements + 1, into nodes
  const Index* nodes = nullptr;    ///< of triangles and quadrilaterals
};

struct CornerSummary {
  Index inverted = 0;   ///< elements with a corner whose area is not positive
  double min_sine = 1;  ///< of all corners; at most 1
};

/// Summarises the corners of the elements [begin, end).
using CornerKernel = CornerSummary (*)(const CornerData&, Index begin, Index end);

/// The kernel for any processor.
CornerKernel portable_corner_kernel();
/// Null if the compiler or the processor does not support AVX2.
CornerKernel avx2_corner_kernel();

}  // namespace winslow
