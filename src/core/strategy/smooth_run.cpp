#include "core/strategy/smooth_run.h"

#include <set>

#include "core/error.h"
#include "core/formulation/box_field.h"
#include "core/motion/contact.h"
#include "core/motion/image_motion.h"
#include "core/motion/transfer.h"
#include "core/problem/node_unknowns.h"
#include "core/quality/quality.h"
#include "core/strategy/face_angles.h"
#include "core/strategy/keep_outside.h"
#include "core/strategy/pointwise_run.h"
#include "core/strategy/sliding.h"
#include "core/strategy/surface_shape.h"
#include "core/strategy/untangling.h"
#include "core/strategy/variational_run.h"
#include "core/strategy/workspace.h"

namespace winslow {

namespace {

/// The largest number of VCV updates.
int most_updates(const Coordinates& given, const SmoothingWorkspace& workspace) {
  constexpr int after_tangle = 10;  // each update halves the remaining change of angles
  const SmoothOptions& options = workspace.options();
  const Topology& topology = workspace.classes().topology();
  if (!workspace.vcvs_follow_mesh()) return 0;
  const bool tangled = check_validity(topology, given, options.threads).inverted > 0;
  return tangled ? std::max(after_tangle, options.vcv_updates) : options.vcv_updates;
}

/// Updates adjusted VCVs as the paper does (AIAA 2009-1362, section V). Adjusts the VCVs to the
/// mesh x of a run, solves for the mesh again, and repeats this until no VCV changes any more, at
/// most SmoothOptions::vcv_updates times. If the mesh as given was tangled, its VCVs are
/// meaningless and are always updated. Does nothing for VCVs of other kinds, and for equations
/// without VCVs.
///
/// solve: runs the solver from a mesh whose boundary is at its final position. given: the mesh from
/// which the VCVs were made. If there is no solution for the next VCVs, x is the last solution.
void update_vcvs(const Coordinates& given, SmoothingWorkspace& workspace, RunRecorder& recorder,
                 const std::function<void(Coordinates&)>& solve, Coordinates& x) {
  const SmoothResult& result = recorder.result();
  if (!result.converged || result.fraction_reached < 1 || !result.limited_by.empty()) return;
  const int most = most_updates(given, workspace);
  for (int update = 0; update < most && recorder.remaining() > 0; ++update) {
    if (workspace.adjust_vcvs(x) == 0) return;
    Coordinates solution = x;
    const RunOutcome outcome = result;
    solve(x);
    // The operator's own solution may be tangled: the next angles may then untangle it.
    if (result.converged && result.inverted <= outcome.inverted) continue;
    x = std::move(solution);
    recorder.restore_outcome(outcome);
    return;
  }
}

bool by_fixed_point(const SmoothOptions& options) { return options.outer == OuterMethod::picard; }

std::unique_ptr<NewtonRun> make_newton_run(const MeshState& state, SmoothingWorkspace& workspace,
                                           RunRecorder& recorder) {
  if (workspace.options().formulation == Formulation::variational) {
    return std::make_unique<VariationalRun>(state, workspace, recorder);
  }
  return std::make_unique<PointwiseRun>(state, workspace, recorder);
}

/// The node classes of a run: the boundary is fixed, except the nodes of a motion and sliding
/// nodes, and so are the nodes outside the region in the options. with_motion: receives the rows
/// that move with the motion.
std::shared_ptr<const NodeClasses> classes_of(const MeshState& state, const Motion* motion,
                                              const SmoothOptions& options, const RunOptions& run,
                                              SmoothResult& result, CurveRows& with_motion) {
  auto classes = std::make_shared<NodeClasses>(state.mesh.topology);
  if (state.surface) {
    slide_on_surface(*state.surface, state.mesh.coordinates, *classes);
    result.boundary.sliding = state.surface->boundary.parts;
    result.boundary.held = static_cast<Index>(state.surface->rules.hold.size());
    for (SlidingPart& part : result.boundary.sliding)
      std::erase_if(part.nodes, [&](Index node) { return !classes->slides(node); });
    result.boundary.interfaces = interfaces_of_surface(*state.surface, *classes);
    return classes;
  }
  const auto moving = motion ? motion->nodes() : std::span<const Index>();
  result.boundary = make_boundary_move({options.slide, run.files}, state.mesh, moving, *classes);
  if (run.bodies)
    let_footholds_slide(options.slide, what_holds_footholds(options), state.mesh, *run.bodies,
                        result.boundary, *classes);
  if (motion) let_bodies_slide(state.mesh, *motion, *classes, result.boundary);
  classes->set_fixed(run.kept ? *run.kept
                              : nodes_kept_outside(options.keep_outside, *state.mesh.topology,
                                                   state.mesh.coordinates, moving));
  classes->set_prescribed(moving);
  with_motion = hold_spacing(options.slide, state.mesh, result.boundary, *classes);
  return classes;
}

/// Moves the fixed interior nodes to their positions in the mesh. Returns how many of these are
/// kept outside a region: neither named nor where regions meet.
Index keep_fixed(const MeshState& state, const NodeClasses& classes,
                 const std::vector<Index>& named, const InterfaceReport& interfaces,
                 Coordinates& x) {
  const auto interior = classes.topology().interior_nodes();
  const auto kept = std::ranges::count_if(
      interior, [&](Index node) { return classes[node] == NodeClass::fixed; });
  if (kept > 0) x = unknowns_within(classes, x, state.mesh.coordinates);
  std::set<Index> alone(named.begin(), named.end());
  alone.insert(interfaces.held.begin(), interfaces.held.end());
  const auto held_inside = std::ranges::count_if(
      alone, [&](Index node) { return !classes.topology().on_boundary(node); });
  return state.surface ? 0 : static_cast<Index>(kept - held_inside);
}

/// The smallest normalized Jacobian; 0 of a mesh with inverted elements.
double worst_of(const SmoothingWorkspace& workspace, const Coordinates& mesh) {
  const Validity found = workspace.validity(mesh);
  return found.inverted > 0 ? 0 : found.min_sine;
}

/// Prevents smoothing in place from making a mesh worse: elements that end below the worst of the
/// mesh as given get a larger weight, and the mesh is solved for again. The result is the mesh with
/// the best worst element.
void keep_above_worst(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder,
                      Coordinates& x) {
  constexpr int rounds = 5;
  constexpr double rounding = 1e-6;
  const SmoothOptions& options = workspace.options();
  if (options.formulation != Formulation::variational || options.targets.automatic == 0) return;
  const Topology& topology = *state.mesh.topology;
  const double enough = worst_of(workspace, state.mesh.coordinates) - rounding;
  SmoothResult& result = recorder.result();
  Coordinates best = x;
  double best_worst = worst_of(workspace, best), best_residual = result.residual;
  std::vector<Index> urgent;
  for (int round = 0; round < rounds && best_worst < enough; ++round) {
    const auto sines = element_values({state.mesh.topology, x}, Metric::normalized_jacobian,
                                      element_normals(workspace.classes(), x, options.threads));
    for (Index e = 0; e < topology.element_count(); ++e)
      if (sines[static_cast<std::size_t>(e)] < enough) urgent.push_back(e);
    workspace.count_more(urgent);
    make_newton_run(state, workspace, recorder)->smooth(x, 1, nullptr);
    if (!result.converged) break;
    const double worst = worst_of(workspace, x);
    if (worst <= best_worst) continue;
    best = x;
    best_worst = worst;
    best_residual = result.residual;
  }
  // The outcome of the run refers to this mesh, which is a solution.
  x = std::move(best);
  result.residual = best_residual;
  result.converged = true;
  result.out_of_iterations = false;
  result.inverted = 0;
}

/// If smoothing in place has lowered the worst element so far that it counts as damage, raises it
/// to where it was, or as far as a few rounds can: with targets that do not suit the mesh no number
/// of rounds would. Smaller losses stay, so that the solution does not depend on the mesh as given.
/// So do those of simplices, in which edges count as well as angles.
void recover_worst(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder,
                   Coordinates& x) {
  constexpr int rounds = 10;
  if (workspace.options().formulation != Formulation::variational) return;
  bool right_angled = false;
  for (Index e = 0; e < state.mesh.topology->element_count() && !right_angled; ++e)
    right_angled = has_box(state.mesh.topology->element_type(e));
  if (!right_angled) return;
  const double enough = worst_of(workspace, state.mesh.coordinates);
  if (worst_of(workspace, x) >= least_sine_kept * enough) return;
  raise_worst_element(workspace, recorder, 1, x, {.enough = enough, .rounds = rounds});
}

/// The result of a motion that has to be complete and cannot be: it is not begun.
SmoothResult not_begun(const MeshState& state, const SmoothOptions& options, const Coordinates& x,
                       SmoothResult result) {
  result.fraction_reached = 0;
  result.converged = false;
  result.inverted = check_validity(*state.mesh.topology, x, options.threads).inverted;
  return result;
}

Index count_inside(const Topology& topology, std::span<const Index> nodes) {
  return static_cast<Index>(
      std::ranges::count_if(nodes, [&](Index node) { return !topology.on_boundary(node); }));
}

/// An element without free nodes blocks a motion if it is inverted before a contact.
void take_if_first(const std::optional<HeldInversion>& inversion, SmoothResult& result) {
  if (!inversion || (result.contact && result.contact->fraction < inversion->fraction)) return;
  result.held_inversion = inversion;
  result.contact.reset();
}

/// Whether a path ended before an element without free nodes is inverted: not earlier, as at a
/// limit. Meshes with slivers, which come first, are given up.
bool ended_by(const std::optional<HeldInversion>& inversion, const SmoothResult& result) {
  constexpr double near = 0.75;
  return inversion && result.fraction_reached < 1 && result.limited_by.empty() &&
         !result.out_of_iterations && result.fraction_reached >= near * inversion->fraction;
}

/// Finds what is certain to block a motion that must be complete: a contact, or an element without
/// free nodes. The search is faster than making targets and matrices, so it comes first, and the
/// motion is not begun.
bool is_blocked(const MeshState& state, const Motion& motion,
                const std::optional<HeldInversion>& inversion, const NodeClasses& classes,
                SmoothResult& result) {
  result.contact = find_contact(*state.mesh.topology, state.mesh.coordinates, motion,
                                yielding_nodes(result.boundary, classes));
  take_if_first(inversion, result);
  return result.contact || result.held_inversion;
}

/// Whether a start may be used: see NearStart.
bool may_start_there(const MeshState& state, const RunOptions& run, const NodeClasses& classes,
                     const MovingBoundary& boundary) {
  const Mesh& mesh = state.mesh;
  return std::ranges::none_of(run.near.beside, [&](const std::vector<MovingBody>& bodies) {
    const auto motion = make_motion(*mesh.topology, mesh.coordinates, std::span(bodies));
    return find_contact(*mesh.topology, mesh.coordinates, *motion,
                        yielding_nodes(boundary, classes))
        .has_value();
  });
}

/// Moves the boundary, and what else a motion takes, and nothing else.
SmoothResult move_alone(const MeshState& state, const Motion& bodies, const SmoothOptions& options,
                        Coordinates& x) {
  SmoothResult result;
  NodeClasses classes(state.mesh.topology);
  classes.set_prescribed(bodies.nodes());
  result.held_inversion =
      find_held_inversion(classes, state.mesh.coordinates, bodies, MotionPart::end);
  bodies.apply(state.mesh.coordinates, 1, x);
  result.prescribed_inside = count_inside(*state.mesh.topology, bodies.nodes());
  result.converged = true;
  result.inverted = check_validity(*state.mesh.topology, x, options.threads).inverted;
  return result;
}

/// Lets a run count the memory of what its stages share: the meshes and the workspace.
void count_memory(const MeshState& state, const SmoothingWorkspace& workspace, const Coordinates& x,
                  RunRecorder& recorder) {
  recorder.count_memory([&](MemoryUse& use) {
    use.mesh += state.mesh.topology->bytes() + state.mesh.coordinates.bytes() + x.bytes();
    workspace.count(use);
  });
}

/// The fixed point may need several attempts at a motion; the limit applies to each.
int budget(const SmoothOptions& options) {
  return by_fixed_point(options) ? std::numeric_limits<int>::max() : options.max_iterations;
}

/// Smooths with the boundary at its final position.
void smooth_at_end(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder,
                   Coordinates& x) {
  const SmoothOptions& options = workspace.options();
  if (!by_fixed_point(options)) {
    make_newton_run(state, workspace, recorder)->smooth(x, 1, nullptr);
    return;
  }
  recorder.iterate(workspace.picard(), x, Stage::picard, 1, options.max_iterations);
  recorder.result().linear_solver = workspace.linear().description();
}

void follow_with_vcvs(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder,
                      Coordinates& x) {
  const auto solve = [&](Coordinates& y) { smooth_at_end(state, workspace, recorder, y); };
  update_vcvs(state.mesh.coordinates, workspace, recorder, solve, x);
}

/// How the walls were stretched from the reference mesh to their positions in the state, or by a
/// motion; null: not at all, or the targets do not depend on it.
std::shared_ptr<const WallStretch> wall_stretch(const MeshState& state,
                                                const std::shared_ptr<const NodeClasses>& classes,
                                                const SmoothOptions& options, const Motion* motion,
                                                const RunOptions& run,
                                                SmoothingWorkspace& workspace,
                                                double fraction = 1) {
  if (options.targets.keep == 0 || is_surface(classes->topology())) return nullptr;
  Coordinates moved = state.mesh.coordinates;
  if (motion) motion->apply(state.mesh.coordinates, fraction, moved);
  return workspace.walls(classes, reference_of(state))
      .stretched(moved, run.layer_factors ? std::span<const double>(*run.layer_factors)
                                          : std::span<const double>());
}

/// Smooths the mesh of a motion that ended early, whose targets were those for stretched walls at
/// the end of the motion. Keeps the mesh if that fails.
void fit_to_walls_reached(const MeshState& state, std::shared_ptr<const WallStretch> reached,
                          const std::shared_ptr<const NodeClasses>& classes,
                          SmoothingWorkspace& workspace, RunRecorder& recorder, Coordinates& x) {
  const SmoothResult& result = recorder.result();
  if (result.inverted > 0 || result.fraction_reached <= 0 || recorder.remaining() <= 0) return;
  const SmoothOptions options = workspace.options();
  workspace.prepare(state, classes, options, state.reference, std::move(reached));
  const RunOutcome outcome = result;
  Coordinates end_of_path = x;
  make_newton_run(state, workspace, recorder)->smooth(x, outcome.fraction_reached, nullptr);
  if (result.converged && result.inverted == 0) return;
  x = std::move(end_of_path);
  recorder.restore_outcome(outcome);
}

/// CellTargets::stretched of a run by Newton's method.
std::optional<double> stretched(SmoothingWorkspace& workspace) {
  if (workspace.options().formulation != Formulation::variational) return std::nullopt;
  return workspace.energy()->stretched();
}

}  // namespace

/// The number of elements that have no shape of their own to keep.
Index without_shape(SmoothingWorkspace& workspace) {
  if (workspace.options().formulation != Formulation::variational) return 0;
  return workspace.energy()->without_shape();
}

/// Raises the worst element. Targets that keep shapes rate an element by its change, so `auto` ones
/// take their place.
void raise_worst(const MeshState& state, const std::shared_ptr<const NodeClasses>& classes,
                 SmoothingWorkspace& workspace, RunRecorder& recorder, double fraction,
                 Coordinates& x) {
  SmoothOptions options = workspace.options();
  if (options.targets.keep > 0) {
    options.targets = TargetBlend::automatically();
    workspace.prepare(state, classes, options, state.reference);
  }
  raise_worst_element(workspace, recorder, fraction, x);
}

SmoothResult smooth_interior(const MeshState& state, const SmoothOptions& asked, Coordinates& x,
                             const RunOptions& run) {
  SmoothResult result;
  SmoothOptions options = asked;
  options.targets = options.targets.or_else(TargetBlend::automatically());
  SolverCache own;
  SmoothingWorkspace& workspace = (run.cache ? *run.cache : own).workspace();
  CurveRows none;
  const auto classes = classes_of(state, nullptr, options, run, result, none);
  workspace.prepare(state, classes, options, options.targets.keep > 0 ? state.reference : nullptr,
                    wall_stretch(state, classes, options, nullptr, run, workspace),
                    run.layer_shapes);
  result.kept_outside = keep_fixed(state, workspace.classes(), options.slide.hold_nodes,
                                   result.boundary.interfaces, x);
  RunRecorder recorder(run.monitor, result, budget(options));
  count_memory(state, workspace, x, recorder);
  smooth_at_end(state, workspace, recorder, x);
  follow_with_vcvs(state, workspace, recorder, x);
  if (by_fixed_point(options)) return result;
  if (result.converged && run.never_worse) keep_above_worst(state, workspace, recorder, x);
  result.stretched = stretched(workspace);
  result.without_shape = without_shape(workspace);
  if (options.raise_worst)
    raise_worst(state, classes, workspace, recorder, 1, x);
  else if (result.converged && run.never_worse)
    recover_worst(state, workspace, recorder, x);
  return result;
}

namespace {

/// Whether a motion has to keep the angles of faces: its own limits come first.
bool heeds_face_angles(const MeshState& state, const SmoothOptions& options,
                       const MotionOptions& how, const SmoothResult& result) {
  return state.mesh.topology->has_polyhedra() && options.formulation == Formulation::variational &&
         options.targets.keep > 0 && !how.floor.given() && result.inverted == 0 &&
         result.fraction_reached > 0;
}

/// Raises the worst element at the end of a motion, or brings back the angles of faces.
void better_end(const MeshState& state, const std::shared_ptr<const NodeClasses>& classes,
                const MotionOptions& how, const WallStretch* stretch, SolverMonitor* monitor,
                SmoothingWorkspace& workspace, RunRecorder& recorder, Coordinates& x) {
  const SmoothOptions options = workspace.options();
  SmoothResult& result = recorder.result();
  if (options.raise_worst)
    raise_worst(state, classes, workspace, recorder, result.fraction_reached, x);
  else if (heeds_face_angles(state, options, how, result))
    result.face_angles = keep_face_angles(state, *classes, options, stretch, monitor, x);
}

/// smooth_motion() of a motion that takes along the images of its nodes.
SmoothResult smooth_complete_motion(const MeshState& state, const Motion& bodies,
                                    const MotionOptions& how, const SmoothOptions& asked,
                                    Coordinates& x, const RunOptions& run) {
  SmoothOptions options = asked;
  options.targets = options.targets.or_else(TargetBlend::keeping());
  if (!how.smooth_after) return move_alone(state, bodies, options, x);
  SmoothResult result;
  SolverCache own;
  SmoothingWorkspace& workspace = (run.cache ? *run.cache : own).workspace();
  CurveRows rows;
  const auto classes = classes_of(state, &bodies, options, run, result, rows);
  const auto stretch = wall_stretch(state, classes, options, &bodies, run, workspace);
  workspace.prepare(state, classes, options, state.reference, stretch);
  const auto with_held_rows = rows.empty() ? nullptr : with_rows(bodies, rows);
  const Motion& motion = with_held_rows ? *with_held_rows : bodies;
  result.kept_outside = keep_fixed(state, workspace.classes(), options.slide.hold_nodes,
                                   result.boundary.interfaces, x);
  result.prescribed_inside = count_inside(*state.mesh.topology, bodies.nodes());
  const bool along_path = how.increments == 0 && !by_fixed_point(options);
  const auto inversion = find_held_inversion(workspace.classes(), state.mesh.coordinates, motion,
                                             along_path ? MotionPart::way : MotionPart::end);
  if (!along_path) result.held_inversion = inversion;
  RunRecorder recorder(run.monitor, result, budget(options));
  count_memory(state, workspace, x, recorder);
  if (by_fixed_point(options)) {
    move_by_fixed_point(state.mesh.coordinates, motion, how.increments, options.max_iterations,
                        workspace.picard(), recorder, x);
    result.linear_solver = workspace.linear().description();
    follow_with_vcvs(state, workspace, recorder, x);
    return result;
  }
  bool near_start = run.start && !how.floor.given();  // limits apply to the whole path
  const bool known =
      run.all_or_nothing && how.increments == 0 && (!near_start || run.near.as_without);
  if (known && is_blocked(state, bodies, inversion, workspace.classes(), result))
    return not_begun(state, options, x, std::move(result));
  near_start = near_start && may_start_there(state, run, workspace.classes(), result.boundary);
  const auto steps = make_newton_run(state, workspace, recorder);
  steps->keep_within(how.floor);
  steps->end_at_contact(run.all_or_nothing);
  if (known) steps->way_is_clear();
  if (inversion) steps->way_is_blocked();
  if (!along_path || !near_start || !steps->start_near(motion, run, x)) {
    if (along_path) x = state.mesh.coordinates;
    steps->move(motion, state.mesh.coordinates, how.increments, x);
  }
  if (stretch && result.fraction_reached < 1 && !how.floor.given()) {
    const auto there =
        wall_stretch(state, classes, options, &bodies, run, workspace, result.fraction_reached);
    fit_to_walls_reached(state, there, classes, workspace, recorder, x);
  }
  if (along_path && ended_by(inversion, result)) take_if_first(inversion, result);
  if (!how.floor.given()) follow_with_vcvs(state, workspace, recorder, x);
  result.stretched = stretched(workspace);
  result.without_shape = without_shape(workspace);
  better_end(state, classes, how, stretch.get(), run.monitor, workspace, recorder, x);
  return result;
}

/// A motion with the images of its nodes across periodic sides, and the bodies that it moves.
struct PeriodicMotion {
  std::unique_ptr<const Motion> motion;  ///< null: no node has an image
  BodyNodes bodies;
};

PeriodicMotion with_images_of_sides(const MeshState& state, const Motion& motion,
                                    const SmoothOptions& options, const RunOptions& run) {
  PeriodicMotion out;
  if (!options.slide.has_pairs() || state.surface) return out;
  const Coordinates& rest = state.mesh.coordinates;
  const auto sides = periodic_pairs({options.slide, run.files}, state.mesh);
  out.motion = with_images(motion, rest, sides);
  if (!out.motion || !run.bodies) return out;
  // An image stands on what is under it as its node does.
  out.bodies = *run.bodies;
  const BodyNodes all = body_nodes(*out.motion, rest);
  for (const Index node : all.all)
    if (!std::ranges::binary_search(motion.nodes(), node)) out.bodies.all.push_back(node);
  for (const Index node : all.standing)
    if (!std::ranges::binary_search(motion.nodes(), node)) out.bodies.standing.push_back(node);
  std::ranges::sort(out.bodies.all);
  std::ranges::sort(out.bodies.standing);
  return out;
}

}  // namespace

SmoothResult smooth_motion(const MeshState& state, const Motion& motion, const MotionOptions& how,
                           const SmoothOptions& asked, Coordinates& x, const RunOptions& run) {
  const PeriodicMotion periodic = with_images_of_sides(state, motion, asked, run);
  if (!periodic.motion) return smooth_complete_motion(state, motion, how, asked, x, run);
  RunOptions with_images = run;
  if (run.bodies) with_images.bodies = &periodic.bodies;
  return smooth_complete_motion(state, *periodic.motion, how, asked, x, with_images);
}

MotionEquations solve_at_end(const MeshState& state, const Motion& motion,
                             const SmoothOptions& asked, const Coordinates& start,
                             const RunOptions& run) {
  SmoothOptions options = independent_of_start(asked);
  options.targets = options.targets.or_else(TargetBlend::keeping());
  // Derivatives need tight solves.
  options.linear.max_iterations = std::max(options.linear.max_iterations, 1000);
  if (options.formulation != Formulation::variational || by_fixed_point(options))
    throw UsageError(
        "what a mesh depends on is known for meshes that minimise an energy: expected the "
        "variational form and Newton's method");
  if (options.raise_worst)
    throw UsageError("raise_worst: a mesh whose worst element was raised minimises no energy");
  const PeriodicMotion periodic = with_images_of_sides(state, motion, options, run);
  const Motion& bodies = periodic.motion ? *periodic.motion : motion;
  RunOptions with_images = run;
  if (periodic.motion && run.bodies) with_images.bodies = &periodic.bodies;
  MotionEquations out;
  CurveRows rows;
  out.classes = classes_of(state, &bodies, options, with_images, out.result, rows);
  out.workspace =
      run.cache ? run.cache->workspace().fork() : std::make_shared<SmoothingWorkspace>();
  SmoothingWorkspace& workspace = *out.workspace;
  workspace.prepare(state, out.classes, options, state.reference,
                    wall_stretch(state, out.classes, options, &bodies, run, workspace));
  Coordinates& x = out.solution = state.mesh.coordinates;
  const auto with_held_rows = rows.empty() ? nullptr : with_rows(bodies, rows);
  const Motion& complete = with_held_rows ? *with_held_rows : bodies;
  complete.apply(state.mesh.coordinates, 1, x);
  out.taken = complete.taken(x);
  if (run.layer_factors) out.layer_factors = *run.layer_factors;
  x = unknowns_within(*out.classes, start, std::move(x));
  const auto energy = workspace.energy();
  energy->advance(std::vector<double>(energy->unknowns(), 0.0), 0, x);  // onto curves, surfaces
  RunRecorder recorder(run.monitor, out.result, options.max_iterations);
  make_newton_run(state, workspace, recorder)->smooth(x, 1, nullptr);
  out.form = std::dynamic_pointer_cast<const VariationalForm>(workspace.newton().shared_problem());
  out.reference = reference_of(state);
  return out;
}

Coordinates starting_point(const MeshState& state, const RunOptions& options) {
  if (!options.start) return state.mesh.coordinates;
  if (!options.start->alike(state.mesh.coordinates))
    throw UsageError("the start has another number of nodes than the mesh");
  Coordinates x = state.mesh.coordinates;
  for (const Index node : state.mesh.topology->interior_nodes()) {
    x.copy_node(node, *options.start);
  }
  return x;
}

}  // namespace winslow
