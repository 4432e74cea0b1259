#include "core/strategy/workspace.h"

#include "core/formulation/target_shapes.h"
#include "core/problem/node_unknowns.h"
#include "core/quality/volume_element.h"
#include "core/strategy/run.h"

namespace winslow {

namespace {

VcvKind chosen_kind(VcvKind kind, const Topology& topology) {
  return kind == VcvKind::automatic && topology.has_polyhedra() ? VcvKind::equal : kind;
}

}  // namespace

VolumeVcvOptions volume_vcv_options(const SmoothOptions& options, const Topology& topology) {
  VolumeVcvOptions vcvs;
  const VcvKind kind = chosen_kind(options.vcv, topology);
  vcvs.threads = options.threads;
  vcvs.length_power = options.vcv_lengths;
  if (kind == VcvKind::equal) vcvs.angles = VcvAngles::equal;
  if (kind == VcvKind::existing) vcvs.angles = VcvAngles::existing;
  if (follows_mesh(kind)) vcvs.angles = VcvAngles::adjusted;
  if (kind == VcvKind::perturbation) vcvs.construction = VcvConstruction::perturbation;
  return vcvs;
}

namespace {

/// Whether VCVs of a volume mesh depend on the mesh as given.
bool vcvs_refer_to_given(const SmoothOptions& options) {
  return options.vcv != VcvKind::equal || options.vcv_lengths != 0;
}

/// Whether the products of one run can be used for another with these classes.
bool same_unknowns(const std::shared_ptr<const NodeClasses>& a, const NodeClasses& b) {
  return a && a->same_unknowns(b) &&
         a->sliding().element_normals() == b.sliding().element_normals();
}

}  // namespace

void SmoothingWorkspace::prepare(const MeshState& state,
                                 const std::shared_ptr<const NodeClasses>& classes,
                                 const SmoothOptions& options,
                                 const std::shared_ptr<const Coordinates>& reference,
                                 std::shared_ptr<const WallStretch> wall_stretch,
                                 std::shared_ptr<const Coordinates> layer_shapes) {
  if (const auto* newton = run_.newton.kept()) matrix_memory_ = (*newton)->take_memory();
  run_ = {};
  const auto& topology = classes->shared_topology();
  if (!classes_ || classes_->shared_topology() != topology)
    made_ = {}, matrix_memory_ = {};  // the keys have changed
  if (wall_layers_ && wall_layers_->classes().shared_topology() != topology) wall_layers_.reset();
  classes_ = classes;
  if (!same_unknowns(unknowns_, *classes)) unknowns_ = classes;
  options_ = options;
  options_.vcv = chosen_kind(options.vcv, classes->topology());
  vcvs_ = state.vcvs;
  roles_ = state.roles;
  wall_stretch_ = std::move(wall_stretch);
  layer_shapes_ = std::move(layer_shapes);
  const Coordinates& given = reference ? *reference : state.mesh.coordinates;
  const bool needs_given = in_space() || refers_to_given(options.targets);
  if (!needs_given)
    given_ = nullptr;
  else if (!given_ || !(*given_ == given))
    given_ = reference ? reference : std::make_shared<const Coordinates>(given);
}

std::shared_ptr<SmoothingWorkspace> SmoothingWorkspace::fork() const {
  auto other = std::make_shared<SmoothingWorkspace>();
  other->unknowns_ = unknowns_;
  other->classes_ = classes_;
  other->given_ = given_;
  other->wall_layers_ = wall_layers_;
  other->made_ = made_;
  other->forget_linear_solvers();
  return other;
}

const WallLayers& SmoothingWorkspace::walls(const std::shared_ptr<const NodeClasses>& classes,
                                            const std::shared_ptr<const Coordinates>& reference) {
  const bool known =
      wall_layers_ && wall_layers_->classes().shared_topology() == classes->shared_topology() &&
      wall_layers_->classes().same_unknowns(*classes) && wall_layers_->reference() == *reference;
  if (!known) wall_layers_.emplace(WallLayers(classes, reference));
  return *wall_layers_;
}

bool SmoothingWorkspace::guard(std::span<const Index> elements) {
  std::vector<Index>& guarded = run_.guarded;
  const std::size_t before = guarded.size();
  guarded.insert(guarded.end(), elements.begin(), elements.end());
  std::ranges::sort(guarded);
  guarded.erase(std::unique(guarded.begin(), guarded.end()), guarded.end());
  return guarded.size() > before;
}

bool SmoothingWorkspace::drop_guards_broken_at(const Coordinates& x) {
  const Topology& topology = classes_->topology();
  const auto broken = [&](Index e) {
    const SpacePoints points(x);
    return std::ranges::any_of(topology.shape(e).edge_tetrahedra, [&](const auto& corners) {
      return VolumeCorner(points, by_nodes(corners, topology.element(e))).inverted();
    });
  };
  return std::erase_if(run_.guarded, broken) > 0;
}

Validity SmoothingWorkspace::validity(const Coordinates& x) const {
  return check_validity(*classes_, x, options_.threads);
}

SmoothingWorkspace::ComputedVcvs SmoothingWorkspace::make_vcvs(const Coordinates& x) const {
  return {std::make_shared<const VolumeVcvs>(classes_->shared_topology(), x,
                                             volume_vcv_options(options_, classes_->topology())),
          follows_mesh(options_.vcv) && tangled(x)};
}

const SmoothingWorkspace::ComputedVcvs& SmoothingWorkspace::computed_vcvs() {
  if (run_.adjusted.vcvs) return run_.adjusted;
  const ComputedVcvsKey key{classes_->shared_topology(), options_.vcv, options_.vcv_lengths,
                            options_.threads, vcvs_refer_to_given(options_) ? given_ : nullptr};
  return made_.computed_vcvs.of(key, [&] { return make_vcvs(*given_); });
}

std::shared_ptr<const VolumeVcvs> SmoothingWorkspace::volume_vcvs() {
  if (!in_space()) return nullptr;
  SpaceVcvs computed = computed_vcvs().vcvs;
  const Stencils stencils = vcvs_.by_hand();
  if (!stencils) return computed;
  return made_.space_vcvs.of({computed, stencils}, [&]() -> SpaceVcvs {
    auto vcvs = std::make_shared<VolumeVcvs>(*computed);
    for (const auto& [node, stencil] : *stencils)
      vcvs->set(node, stencil.directions, stencil.lengths);
    return vcvs;
  });
}

Index SmoothingWorkspace::adjust_vcvs(const Coordinates& x) {
  if (!in_space() || !follows_mesh(options_.vcv)) return 0;
  const ComputedVcvs before = computed_vcvs();
  if (before.of_tangle && !tangled(x)) {
    // Neither angles nor lengths of a tangled mesh are useful.
    run_.adjusted = make_vcvs(x);
    return classes_->topology().node_count();
  }
  auto vcvs = std::make_shared<VolumeVcvs>(*before.vcvs);
  const Index changed = vcvs->adjust(x);
  if (changed > 0) run_.adjusted = {std::move(vcvs), before.of_tangle};
  return changed;
}

bool SmoothingWorkspace::adjust_tangled_vcvs(const Coordinates& x) {
  return vcvs_follow_mesh() && computed_vcvs().of_tangle && adjust_vcvs(x) > 0;
}

const std::shared_ptr<LinearSolver>& SmoothingWorkspace::general_solver(KeyedSolver& solver) {
  return solver.of({unknowns_, options_.threads, options_.linear}, [&] {
    // A solver for symmetric matrices only is still used for the variational form; the pointwise
    // form's systems, needed for untangling, then use the automatic choice.
    LinearOptions chosen = options_.linear;
    if (linear_solver_needs_symmetry(chosen.solver)) chosen.solver = "automatic";
    return std::shared_ptr<LinearSolver>(make_linear_solver(chosen, options_.threads));
  });
}

const std::shared_ptr<LinearSolver>& SmoothingWorkspace::shared_symmetric_linear() {
  return made_.symmetric_linear.of({unknowns_, options_.threads, options_.linear}, [&] {
    return std::shared_ptr<LinearSolver>(make_linear_solver(options_.linear, options_.threads));
  });
}

ClipVariants<EquationProblem> SmoothingWorkspace::pointwise() {
  const auto& pattern = made_.pointwise_pattern.of({unknowns_, options_.threads}, [&] {
    return std::make_shared<const PointwisePattern>(unknowns_, options_.threads);
  });
  const PointwiseKey key{pattern, vcvs_.plane(), volume_vcvs()};
  return made_.pointwise.of(key, [&] {
    return key.space_vcvs ? clip_variants(PointwiseForm<3>(*key.space_vcvs, *key.pattern))
                          : clip_variants(PointwiseForm<2>(*key.plane_vcvs, *key.pattern));
  });
}

SmoothingWorkspace::FormKey SmoothingWorkspace::form_key() {
  const TargetBlend& targets = options_.targets;
  EnergyPatternKey pattern{unknowns_, options_.threads, run_.guarded, nullptr};
  if (!run_.guarded.empty() && targets.rest > 0) pattern.given = given_;
  return {std::move(pattern),
          targets,
          refers_to_given(targets) ? given_ : nullptr,
          vcvs_.plane(),
          targets.vcv > 0 ? volume_vcvs() : nullptr,
          vcvs_.by_hand(),
          roles_,
          run_.urgent,
          wall_stretch_,
          layer_shapes_};
}

template <typename Form>
const typename Form::Pattern& SmoothingWorkspace::energy_pattern(
    const EnergyPatternKey& key, const typename Form::Targets& targets) {
  using Pattern = std::shared_ptr<const typename Form::Pattern>;
  return *std::get<Pattern>(made_.energy_pattern.of(key, [&]() -> EnergyPattern {
    return std::make_shared<const typename Form::Pattern>(key.unknowns, targets, key.threads);
  }));
}

std::shared_ptr<const VariationalForm> SmoothingWorkspace::make_form(const FormKey& key) {
  const NodeClasses* classes = key.pattern.unknowns.get();
  const int threads = key.pattern.threads;
  if (!key.plane_vcvs) {  // of a volume mesh
    const CellTargets<3> targets =
        volume_targets(classes->topology(), key.space_vcvs.get(), key.targets, key.given.get(),
                       threads, key.urgent,
                       {classes, key.stencils.get(), key.pattern.guarded, key.roles.get(),
                        key.wall_stretch.get(), key.layer_shapes.get()});
    return std::make_shared<const VolumeWinslow>(
        energy_pattern<VolumeWinslow>(key.pattern, targets), targets, options_.penalty);
  }
  const auto normals =
      key.given ? element_normals(*classes, *key.given, threads) : std::vector<Vec3>();
  TargetShapes targets =
      TargetShapes::build(*key.plane_vcvs, key.targets, key.given.get(), threads, key.urgent,
                          classes, normals, {key.roles.get(), key.wall_stretch.get()});
  if (!is_surface(classes->topology()))
    return std::make_shared<const VariationalWinslow>(
        energy_pattern<VariationalWinslow>(key.pattern, targets), targets, options_.penalty);
  const auto shared = std::make_shared<const CellTargets<2>>(std::move(targets));
  return std::make_shared<const SurfaceWinslow>(
      energy_pattern<SurfaceWinslow>(key.pattern, *shared), shared, options_.penalty);
}

/// The form of a key from the last one if they differ in the stretch of walls alone: in the targets
/// of the elements over these walls. Null if there is no such way.
std::shared_ptr<const VariationalForm> SmoothingWorkspace::stretched_form(
    const FormKey& key, FormKey last, std::shared_ptr<const VariationalForm> form) {
  std::vector<Index> elements;
  for (const auto* stretch : {last.wall_stretch.get(), key.wall_stretch.get()})
    if (stretch)
      elements.insert(elements.end(), stretch->elements().begin(), stretch->elements().end());
  std::ranges::sort(elements);
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  last.wall_stretch = key.wall_stretch;
  if (!(last == key)) return nullptr;
  const bool any_without_shape = form->without_shape() > 0;
  const auto stretched = [&]<int D>(std::shared_ptr<const SimplexWinslow<D>> same) {
    form.reset();
    return SimplexWinslow<D>::with_targets(std::move(same),
                                           targets_of<D>(key, elements, any_without_shape));
  };
  if (auto space = std::dynamic_pointer_cast<const VolumeWinslow>(form))
    return stretched(std::move(space));
  if (auto plane = std::dynamic_pointer_cast<const VariationalWinslow>(form))
    return stretched(std::move(plane));
  return nullptr;
}

template <int D>
TargetsOfSome<D> SmoothingWorkspace::targets_of(const FormKey& key, std::span<const Index> elements,
                                                bool any_without_shape) {
  const NodeClasses* classes = key.pattern.unknowns.get();
  const int threads = key.pattern.threads;
  if constexpr (D == 2) {
    return TargetShapes::build_some(elements, *key.plane_vcvs, key.targets, key.given.get(),
                                    threads, key.urgent, classes,
                                    {key.roles.get(), key.wall_stretch.get(), any_without_shape});
  } else {
    return volume_targets_of(elements, classes->topology(), key.space_vcvs.get(), key.targets,
                             key.given.get(), threads, key.urgent,
                             {classes, key.stencils.get(), key.pattern.guarded, key.roles.get(),
                              key.wall_stretch.get(), key.layer_shapes.get(), any_without_shape});
  }
}

std::shared_ptr<const VariationalForm> SmoothingWorkspace::energy() {
  const FormKey key = form_key();
  std::shared_ptr<const VariationalForm> stretched;
  if (auto last = made_.form.take_other(key)) {
    made_.energy = {};  // nothing else has the last form: its targets need not be copied
    stretched = stretched_form(key, std::move(last->first), std::move(last->second));
  }
  const auto& form = made_.form.of(key, [&] { return stretched ? stretched : make_form(key); });
  return made_.energy.of({form, options_.penalty}, [&] {
    return form->penalty() == options_.penalty ? form : form->with_penalty(options_.penalty);
  });
}

template <int D>
TargetsOfSome<D> SmoothingWorkspace::targets_with(const std::shared_ptr<const WallStretch>& stretch,
                                                  std::span<const Index> elements) {
  FormKey key = form_key();
  key.wall_stretch = stretch;
  return targets_of<D>(key, elements, energy()->without_shape() > 0);
}
template TargetsOfSome<2> SmoothingWorkspace::targets_with<2>(
    const std::shared_ptr<const WallStretch>& stretch, std::span<const Index> elements);
template TargetsOfSome<3> SmoothingWorkspace::targets_with<3>(
    const std::shared_ptr<const WallStretch>& stretch, std::span<const Index> elements);

void SmoothingWorkspace::forget_linear_solvers() {
  run_ = {};
  made_.linear = {};
  made_.symmetric_linear = {};
  made_.newton_linear = {};
}

PicardSolver& SmoothingWorkspace::picard() {
  const ClipVariants<EquationProblem> problems = pointwise();
  const auto& linear = general_solver(made_.linear);
  return *run_.picard.of({problems.plain, linear}, [&] {
    return std::make_unique<PicardSolver>(
        ClipVariants<FixedPointProblem>{problems.plain, problems.clipped}, *linear,
        equation_options(options_, cell_dimension()));
  });
}

EquationNewton& SmoothingWorkspace::pointwise_newton() {
  const ClipVariants<EquationProblem> problems = pointwise();
  const auto& linear = general_solver(made_.newton_linear);
  return *run_.pointwise_newton.of({problems.plain, linear}, [&] {
    return std::make_unique<EquationNewton>(problems, *linear,
                                            equation_options(options_, cell_dimension()));
  });
}

EnergyNewton& SmoothingWorkspace::newton() {
  const auto problem = energy();
  const auto& linear = shared_symmetric_linear();
  return *run_.newton.of({problem, linear}, [&] {
    return std::make_unique<EnergyNewton>(problem, *linear,
                                          newton_options(options_, cell_dimension()),
                                          std::exchange(matrix_memory_, {}));
  });
}

SteadySolver& SmoothingWorkspace::steady_solver() {
  if (options_.formulation == Formulation::variational) return newton();
  return pointwise_newton();
}

SmoothingWorkspace::TimesMade SmoothingWorkspace::times_made() const {
  return {made_.energy_pattern.times_made(), made_.pointwise_pattern.times_made(),
          made_.form.times_made(), made_.computed_vcvs.times_made(),
          made_.linear.times_made() + made_.symmetric_linear.times_made() +
              made_.newton_linear.times_made()};
}

void SmoothingWorkspace::count(MemoryUse& use) const {
  if (const auto* form = made_.form.kept()) (*form)->count(use);
  if (const auto* pattern = made_.pointwise_pattern.kept())
    use.structure += (*pattern)->rows->bytes();
  if (const auto* vcvs = made_.computed_vcvs.kept()) use.targets += vcvs->vcvs->bytes();
  if (run_.adjusted.vcvs) use.targets += run_.adjusted.vcvs->bytes();
  if (wall_layers_) use.targets += wall_layers_->bytes();
  use.matrix += bytes_of(matrix_memory_);
  for (const KeyedSolver* solver : {&made_.linear, &made_.symmetric_linear, &made_.newton_linear})
    if (const auto* linear = solver->kept()) (*linear)->count(use);
}

SolverCache::SolverCache() = default;
SolverCache::~SolverCache() = default;
SolverCache::SolverCache(SolverCache&& other) noexcept = default;
SolverCache& SolverCache::operator=(SolverCache&& other) noexcept = default;

void SolverCache::clear() { workspace_.reset(); }

void SolverCache::forget_matrices() {
  if (workspace_) workspace_->forget_linear_solvers();
}

SmoothingWorkspace& SolverCache::workspace() {
  if (!workspace_) workspace_ = std::make_unique<SmoothingWorkspace>();
  return *workspace_;
}

}  // namespace winslow
