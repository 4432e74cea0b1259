#pragma once

#include "core/vcv/sphere/volume_vcvs.h"

namespace winslow {

/// What the VCVs of a mesh came out as: what AIAA 2009-1362 tells of its own, and how near they are
/// to what was wanted. VCVs that were set do not count.
struct VolumeVcvStatistics {
  Index stars = 0;
  Index triangles = 0;
  double min_angle = 0, max_angle = 0;  ///< solid angles, in steradians
  double min_cost = 0, max_cost = 0;    ///< of a vertex of a star, see star_cost()
  double mean_error = 0;                ///< of |Omega / Omega* - 1| over all triangles
  double max_error = 0;
  Index off = 0;               ///< stars with a triangle that is off by more than 0.1 %
  Index limited_by_shape = 0;  ///< those whose fit ended so, see SphereFitEnd
  Index out_of_steps = 0;
};

/// threads: 0 for all cores; no result depends on it.
VolumeVcvStatistics measure_vcvs(const VolumeVcvs& vcvs, int threads = 0);

}  // namespace winslow
