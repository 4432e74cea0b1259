#include "core/command/workspace.h"

#include "core/outer/picard_solver.h"

namespace winslow {

OuterSolver& SmoothingWorkspace::prepare(const std::shared_ptr<const VirtualControlVolumes>& vcv,
                                         const SmoothOptions& options) {
  const bool same_vcv = vcv == vcv_;
  outer_.reset();
  if (!formulation_ || !same_vcv || formulation_->name() != options.formulation ||
      options_.threads != options.threads) {
    formulation_ = std::make_unique<PointwiseWinslow>(*vcv, options.threads);
  }
  if (!linear_ || !same_vcv || !(options.linear == options_.linear) ||
      options_.threads != options.threads) {
    linear_ = make_linear_solver(options.linear, options.threads);
  }
  vcv_ = vcv;
  options_ = options;
  outer_ = std::make_unique<PicardSolver>(vcv_->topology(), *formulation_, *linear_, options_);
  return *outer_;
}

}  // namespace winslow
