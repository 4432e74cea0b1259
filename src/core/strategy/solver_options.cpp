#include "core/strategy/solver_options.h"

namespace winslow {

VolumeVcvOptions volume_vcv_options(const SmoothOptions& options) {
  VolumeVcvOptions vcvs;
  vcvs.threads = options.threads;
  vcvs.length_power = options.vcv_lengths;
  if (options.vcv == VcvKind::equal) vcvs.angles = VcvAngles::equal;
  if (options.vcv == VcvKind::existing) vcvs.angles = VcvAngles::existing;
  if (follows_mesh(options.vcv)) vcvs.angles = VcvAngles::adjusted;
  if (options.vcv == VcvKind::perturbation) vcvs.construction = VcvConstruction::perturbation;
  return vcvs;
}

}  // namespace winslow
