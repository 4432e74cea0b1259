#include "core/strategy/workspace.h"

#include <algorithm>
#include <utility>

#include "core/formulation/surface_winslow.h"
#include "core/problem/node_unknowns.h"
#include "core/quality/volume_element.h"

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

namespace {

bool same_vcv_options(const SmoothOptions& a, const SmoothOptions& b) {
  return a.vcv == b.vcv && a.vcv_lengths == b.vcv_lengths;
}

/// Whether VCVs of a volume mesh depend on the mesh as given.
bool refers_to_mesh(const SmoothOptions& options) {
  return options.vcv != VcvKind::equal || options.vcv_lengths != 0;
}

}  // namespace

void SmoothingWorkspace::prepare(const std::shared_ptr<const VirtualControlVolumes>& vcv,
                                 const std::shared_ptr<const NodeClasses>& classes,
                                 const SmoothOptions& options, const Coordinates& given,
                                 std::shared_ptr<const SphereStencils> stencils) {
  const bool same_unknowns =
      classes_ && classes_->same_unknowns(*classes) && options_.threads == options.threads;
  const bool space = classes->topology().cell_dimension() == 3;
  const bool needs_given = space || refers_to_given(options.targets);
  const bool same_given = !needs_given || (given_ && *given_ == given);
  const bool same_vcv =
      same_unknowns && !adjusted_ &&
      (space ? same_vcv_options(options_, options) && (same_given || !refers_to_mesh(options))
             : vcv == vcv_);
  // Targets of a plane mesh have to do with its VCVs in any case: some of them may be edited.
  const bool same_stencils = stencils == stencils_;
  const bool same_targets = same_unknowns && same_stencils && options_.targets == options.targets &&
                            (same_given || !refers_to_given(options.targets)) &&
                            (same_vcv || (space && options.targets.vcv == 0));
  picard_.reset();
  newton_.reset();
  pointwise_newton_.reset();
  pointwise_stale_ |= !same_vcv || !same_stencils;
  energy_stale_ |= !same_targets || !urgent_.empty();
  urgent_.clear();
  if (!same_unknowns) pointwise_ = {};
  if (!same_unknowns || !guarded_.empty()) energy_.reset();
  guarded_.clear();
  if (!same_unknowns || !(options.linear == options_.linear)) {
    linear_.reset();
    symmetric_linear_.reset();
    newton_linear_.reset();
  }
  if (!needs_given) given_.reset();
  if (needs_given && !same_given) given_ = given;
  if (!same_vcv) volume_vcvs_.reset();
  if (!same_stencils) take_stencils(std::move(stencils));
  adjusted_ = false;
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

const VolumeVcvs& SmoothingWorkspace::volume_vcvs() {
  if (!volume_vcvs_) make_volume_vcvs(*given_);
  return *volume_vcvs_;
}

void SmoothingWorkspace::make_volume_vcvs(const Coordinates& x) {
  volume_vcvs_ =
      std::make_unique<VolumeVcvs>(classes_->shared_topology(), x, volume_vcv_options(options_));
  tangled_vcvs_ = follows_mesh(options_.vcv) && tangled(x);
  if (!stencils_) return;
  for (const auto& [node, stencil] : *stencils_)
    volume_vcvs_->set(node, stencil.directions, stencil.lengths);
}

/// All other VCVs stay as they are: under the mouse one changes many times a second.
void SmoothingWorkspace::take_stencils(std::shared_ptr<const SphereStencils> stencils) {
  static const SphereStencils none;
  const SphereStencils& before = stencils_ ? *stencils_ : none;
  const SphereStencils& after = stencils ? *stencils : none;
  if (volume_vcvs_) {
    for (const auto& [node, stencil] : before)
      if (!after.contains(node)) volume_vcvs_->reset(node);
    for (const auto& [node, stencil] : after) {
      const auto found = before.find(node);
      if (found == before.end() || found->second != stencil)
        volume_vcvs_->set(node, stencil.directions, stencil.lengths);
    }
  }
  stencils_ = std::move(stencils);
}

Index SmoothingWorkspace::adjust_vcvs(const Coordinates& x) {
  if (!in_space() || !follows_mesh(options_.vcv)) return 0;
  volume_vcvs();
  Index changed = classes_->topology().node_count();
  if (tangled_vcvs_ && !tangled(x))
    make_volume_vcvs(x);  // neither angles nor lengths of a tangle are worth keeping
  else
    changed = volume_vcvs_->adjust(x);
  if (changed == 0) return 0;
  adjusted_ = pointwise_stale_ = true;
  energy_stale_ |= options_.targets.vcv > 0;
  picard_.reset();
  newton_.reset();
  pointwise_newton_.reset();
  return changed;
}

bool SmoothingWorkspace::adjust_tangled_vcvs(const Coordinates& x) {
  if (!in_space() || !refers_to_vcvs(options_)) return false;
  volume_vcvs();
  return tangled_vcvs_ && adjust_vcvs(x) > 0;
}

bool SmoothingWorkspace::tangled(const Coordinates& x) const { return validity(x).inverted > 0; }

Validity SmoothingWorkspace::validity(const Coordinates& x) const {
  return check_validity(*classes_, x, options_.threads);
}

template <int D>
void SmoothingWorkspace::make_pointwise(const typename PointwiseForm<D>::Vcvs& vcvs) {
  pointwise_ = clip_variants(
      pointwise_.plain ? static_cast<const PointwiseForm<D>&>(*pointwise_.plain).with_vcvs(vcvs)
                       : PointwiseForm<D>(vcvs, classes_, options_.threads));
}

const ClipVariants<EquationProblem>& SmoothingWorkspace::pointwise() {
  if (!pointwise_.plain || pointwise_stale_) {
    if (in_space())
      make_pointwise<3>(volume_vcvs());
    else
      make_pointwise<2>(*vcv_);
  }
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

bool SmoothingWorkspace::guard(std::span<const Index> elements) {
  const std::size_t before = guarded_.size();
  guarded_.insert(guarded_.end(), elements.begin(), elements.end());
  std::ranges::sort(guarded_);
  guarded_.erase(std::unique(guarded_.begin(), guarded_.end()), guarded_.end());
  if (guarded_.size() == before) return false;
  energy_.reset();  // it has other cells
  newton_.reset();
  return true;
}

bool SmoothingWorkspace::drop_guards_broken_at(const Coordinates& x) {
  const Topology& topology = classes_->topology();
  const auto broken = [&](Index e) {
    const SpacePoints points(x);
    return std::ranges::any_of(edge_tetrahedra(topology.element_type(e)), [&](const auto& corners) {
      return VolumeCorner(points, by_nodes(corners, topology.element(e))).inverted();
    });
  };
  if (std::erase_if(guarded_, broken) == 0) return false;
  energy_.reset();
  newton_.reset();
  return true;
}

std::shared_ptr<const VariationalForm> SmoothingWorkspace::energy() {
  if (!energy_ || energy_stale_) {
    if (in_space()) {
      const VolumeVcvs* vcvs = options_.targets.vcv > 0 ? &volume_vcvs() : nullptr;
      make_energy(volume_targets(classes_->topology(), vcvs, options_.targets, given(),
                                 options_.threads, urgent_,
                                 {classes_.get(), stencils_.get(), guarded_}));
    } else if (on_surface()) {
      energy_ = surface_energy();
    } else {
      make_energy<2>(TargetShapes::build(*vcv_, options_.targets, given(), options_.threads,
                                         urgent_, classes_.get()));
    }
  }
  energy_stale_ = false;
  return energy_;
}

std::shared_ptr<const VariationalForm> SmoothingWorkspace::surface_energy() {
  const auto normals =
      given_ ? element_normals(*classes_, *given_, options_.threads) : std::vector<Vec3>();
  auto targets = std::make_shared<const TargetShapes>(TargetShapes::build(
      *vcv_, options_.targets, given(), options_.threads, urgent_, classes_.get(), normals));
  if (energy_) return static_cast<const SurfaceWinslow&>(*energy_).with_shapes(std::move(targets));
  return std::make_shared<const SurfaceWinslow>(classes_, std::move(targets), options_.penalty,
                                                options_.threads);
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
