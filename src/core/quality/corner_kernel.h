#pragma once

#include "core/types.h"

/// The loop behind check_validity, four corners at a time, in machine code for the processor at
/// hand. Every version gives the same bits as Corner.
namespace winslow {

struct CornerData {
  const double* x = nullptr;       ///< #nodes by 2
  const Index* offsets = nullptr;  ///< #elements + 1, into nodes
  const Index* nodes = nullptr;    ///< of triangles and quadrilaterals
};

struct CornerSummary {
  Index inverted = 0;   ///< elements with a corner without positive area
  double min_sine = 1;  ///< of all corners; at most 1
};

/// Of the elements [begin, end).
using CornerKernel = CornerSummary (*)(const CornerData&, Index begin, Index end);

/// For any processor.
CornerKernel portable_corner_kernel();
/// Null where compiler or processor have no AVX2.
CornerKernel avx2_corner_kernel();

}  // namespace winslow
