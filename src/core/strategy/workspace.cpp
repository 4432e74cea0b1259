#include "core/strategy/workspace.h"

#include <utility>

#include "core/strategy/solver_options.h"

namespace winslow {

void SmoothingWorkspace::prepare(const std::shared_ptr<const VirtualControlVolumes>& vcv,
                                 const std::shared_ptr<const NodeClasses>& classes,
                                 const SmoothOptions& options, const Coordinates& given) {
  const bool same_unknowns =
      classes_ && classes_->same_unknowns(*classes) && options_.threads == options.threads;
  const bool same_vcv = same_unknowns && vcv == vcv_;
  const bool same_targets = same_vcv && options_.targets == options.targets &&
                            (!refers_to_given(options.targets) || (given_ && *given_ == given));
  picard_.reset();
  newton_.reset();
  pointwise_newton_.reset();
  pointwise_stale_ |= !same_vcv;
  energy_stale_ |= !same_targets || !urgent_.empty();
  urgent_.clear();
  if (!same_unknowns) {
    pointwise_ = {};
    energy_.reset();
  }
  if (!same_unknowns || !(options.linear == options_.linear)) {
    linear_.reset();
    symmetric_linear_.reset();
    newton_linear_.reset();
  }
  if (refers_to_given(options.targets)) {
    if (!same_targets) given_ = given;
  } else {
    given_.reset();
  }
  vcv_ = vcv;
  classes_ = classes;
  options_ = options;
  if (energy_ && !(energy_->penalty() == options.penalty))
    energy_ = energy_->with_penalty(options.penalty);
}

std::unique_ptr<LinearSolver> SmoothingWorkspace::make_general_solver() const {
  // One that takes symmetric matrices only still serves the variational form; the pointwise form's
  // systems, needed for untangling, then go to the automatic choice.
  LinearOptions chosen = options_.linear;
  if (linear_solver_needs_symmetry(chosen.solver)) chosen.solver = "automatic";
  return make_linear_solver(chosen, options_.threads);
}

LinearSolver& SmoothingWorkspace::linear() {
  if (!linear_) linear_ = make_general_solver();
  return *linear_;
}

LinearSolver& SmoothingWorkspace::newton_linear() {
  if (!newton_linear_) newton_linear_ = make_general_solver();
  return *newton_linear_;
}

LinearSolver& SmoothingWorkspace::symmetric_linear() {
  if (!symmetric_linear_) {
    symmetric_linear_ = make_linear_solver(options_.linear, options_.threads);
  }
  return *symmetric_linear_;
}

const ClipVariants<PointwiseWinslow>& SmoothingWorkspace::pointwise() {
  if (!pointwise_.plain)
    pointwise_ = clip_variants(PointwiseWinslow(*vcv_, classes_, options_.threads));
  else if (pointwise_stale_)
    pointwise_ = clip_variants(pointwise_.plain->with_vcvs(*vcv_));
  pointwise_stale_ = false;
  return pointwise_;
}

PicardSolver& SmoothingWorkspace::picard() {
  if (!picard_) {
    const auto& [plain, clipped] = pointwise();
    picard_ = std::make_unique<PicardSolver>(ClipVariants<FixedPointProblem>{plain, clipped},
                                             linear(), equation_options(options_));
  }
  return *picard_;
}

template <int D>
void SmoothingWorkspace::make_energy(const CellTargets<D>& targets) {
  if (!energy_) {
    energy_ = std::make_shared<const SimplexWinslow<D>>(classes_, targets, options_.penalty,
                                                        options_.threads);
  } else {
    energy_ = static_cast<const SimplexWinslow<D>&>(*energy_).with_shapes(targets);
  }
}

void SmoothingWorkspace::count_more(std::vector<Index> elements) {
  urgent_ = std::move(elements);
  energy_stale_ = true;
  newton_.reset();
}

std::shared_ptr<const VariationalForm> SmoothingWorkspace::energy() {
  if (!energy_ || energy_stale_) {
    if (classes_->topology().cell_dimension() == 3) {
      make_energy(volume_targets(classes_->topology(), options_.targets, given(), options_.threads,
                                 urgent_));
    } else {
      make_energy<2>(
          TargetShapes::build(*vcv_, options_.targets, given(), options_.threads, urgent_));
    }
  }
  energy_stale_ = false;
  return energy_;
}

EnergyNewton& SmoothingWorkspace::newton() {
  if (!newton_) {
    newton_ =
        std::make_unique<EnergyNewton>(energy(), symmetric_linear(), newton_options(options_));
  }
  return *newton_;
}

SteadySolver& SmoothingWorkspace::steady_solver() {
  if (options_.formulation == "variational") return newton();
  return pointwise_newton();
}

EquationNewton& SmoothingWorkspace::pointwise_newton() {
  if (!pointwise_newton_) {
    const auto& [plain, clipped] = pointwise();
    pointwise_newton_ = std::make_unique<EquationNewton>(
        ClipVariants<EquationProblem>{plain, clipped}, newton_linear(), equation_options(options_));
  }
  return *pointwise_newton_;
}

}  // namespace winslow
