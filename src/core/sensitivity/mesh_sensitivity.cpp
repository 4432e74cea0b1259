#include "core/sensitivity/mesh_sensitivity.h"

#include "core/command/local_command.h"
#include "core/error.h"
#include "core/sensitivity/layer_response.h"
#include "core/sensitivity/target_response.h"
#include "core/strategy/workspace.h"

namespace winslow {

namespace {

/// The result of a motion by its mesh. The corrections of held layers are found by the motion.
CommandResult result_at(const MeshState& state, const ResolvedCommand& motion,
                        const Coordinates& moved, const RunOptions& options) {
  CommandResult result{state, {}};
  if (holds_layers(state)) {
    RunOptions run = options;
    run.start = &moved;
    result = execute(motion, state, run);
  }
  result.state.mesh.coordinates = moved;
  return result;
}

/// The number of heights that the result holds.
Index held_heights(const CommandResult& result) {
  if (result.smooth.layers_held) return result.smooth.layers_held->heights;
  const auto& layers = result.state.layers;
  std::size_t heights = 0;
  if (layers && layers->held)
    for (const LayerColumn& column : layers->columns) heights += column.count();
  return static_cast<Index>(heights);
}

}  // namespace

class MeshSensitivity::Impl {
 public:
  Impl(const MeshState& state, const ResolvedCommand& motion, const CommandResult& result,
       const RunOptions& options)
      : equations_(equations_of(motion, state, result, options)), heights_(held_heights(result)) {
    const Coordinates& moved = result.state.mesh.coordinates;
    require_solution();
    const Topology& topology = equations_.classes->topology();
    std::vector<bool> taken(at(topology.node_count()), false);
    for (const TakenNode& node : equations_.taken) taken[at(node.node)] = true;
    for (Index node = 0; node < topology.node_count(); ++node)
      if (!equations_.classes->moves(node) && !taken[at(node)]) boundary_.push_back(node);
    prepare_targets();
    if (result.state.vcvs != state.vcvs) prepare_layers(result.state);
    prepare_solver();
    // The equations are in coordinates near the mesh.
    mesh_ = LocalFrame(state.mesh).to_mesh(equations_.solution, moved);
    compare(topology, moved);
  }

  const Coordinates& mesh() const { return mesh_; }
  double distance() const { return distance_; }
  const std::vector<Index>& boundary() const { return boundary_; }

  Coordinates forward(const Coordinates& given) const {
    require_alike(given);
    Coordinates out(mesh_.dimension(), mesh_.size());
    for (const Index node : boundary_) out.copy_node(node, given);
    for (const auto& [node, leaders] : equations_.taken) {
      Vec3 velocity = Vec3::Zero();
      for (const auto& [leader, map] : leaders) velocity += map * place_of(out, leader);
      set_place(out, node, velocity);
    }
    Coordinates forces = form().hessian_product(equations_.solution, out);
    if (targets_) targets_->add_forces(out, forces);
    if (layers_) layers_->add_forces(out, forces);
    std::vector<double> rhs(form().unknowns());
    form().velocities_transpose(equations_.solution, forces, rhs);
    for (double& value : rhs) value = -value;
    form().velocities(equations_.solution, solve(rhs), out);
    return out;
  }

  Coordinates transpose(const Coordinates& function) const {
    require_alike(function);
    std::vector<double> rhs(form().unknowns());
    form().velocities_transpose(equations_.solution, function, rhs);
    Coordinates multipliers(mesh_.dimension(), mesh_.size());
    form().velocities(equations_.solution, solve(rhs), multipliers);
    Coordinates response = form().hessian_product(equations_.solution, multipliers);
    if (targets_) targets_->add_transpose(multipliers, response);
    if (layers_) layers_->add_transpose(multipliers, response);
    Coordinates out(mesh_.dimension(), mesh_.size());
    const auto add = [&](Index node, const Vec3& more) {
      set_place(out, node, place_of(out, node) + more);
    };
    const auto add_own = [&](Index node) {
      add(node, place_of(function, node) - place_of(response, node));
    };
    for (const Index node : boundary_) add_own(node);
    for (const TakenNode& taken : equations_.taken) add_own(taken.node);
    for (auto taken = equations_.taken.rbegin(); taken != equations_.taken.rend(); ++taken) {
      const Vec3 of_node = place_of(out, taken->node);
      set_place(out, taken->node, Vec3::Zero());
      for (const auto& [leader, map] : taken->leaders) add(leader, map.transpose() * of_node);
    }
    return out;
  }

  Frozen frozen() const {
    const PenaltyOptions& penalty = form().penalty();
    return {penalty.knee, penalty.raise, form().stuck_nodes(), heights_};
  }
  std::string solver() const {
    const std::lock_guard lock(mutex_);
    return linear_->description();
  }

 private:
  static constexpr double tight = 1e-12;  // relative residual of linear solves

  const VariationalForm& form() const { return *equations_.form; }

  void require_solution() const {
    const SmoothResult& result = equations_.result;
    if (result.converged && equations_.form) return;
    char residual[32];
    std::snprintf(residual, sizeof residual, "%.1e", result.residual);
    throw NumericError(
        "the mesh is no solution of its equations, and none was found near it (residual " +
        std::string(residual) +
        "): its derivative is not defined. Expected the converged result of the motion");
  }
  /// Refuses a boundary that lies elsewhere in the moved mesh, and finds distance().
  void compare(const Topology& topology, const Coordinates& moved) {
    constexpr double round_off = 1e-6;  // of an edge
    for (Index node = 0; node < topology.node_count(); ++node) {
      if (!topology.used(node)) continue;
      double edges = 0;
      const auto neighbours = topology.neighbours(node);
      for (const Index other : neighbours)
        edges += (place_of(mesh_, other) - place_of(mesh_, node)).norm();
      const double edge = edges / static_cast<double>(neighbours.size());
      const double off = (place_of(mesh_, node) - place_of(moved, node)).norm() / edge;
      distance_ = std::max(distance_, off);
      if (off < round_off || equations_.classes->moves(node)) continue;
      std::string names;
      for (const Marker& marker : topology.markers())
        for (const Face& face : marker.faces)
          if (std::ranges::find(face, node) != face.end() && !names.ends_with(marker.name))
            names += (names.empty() ? " of " : ", ") + marker.name;
      throw UsageError("node " + std::to_string(node) + names +
                       " has moved, and the motion leaves it where it was: expected the names of "
                       "all markers that moved, and those of markers that slid as sliding ones");
    }
  }
  void require_alike(const Coordinates& given) const {
    if (given.alike(mesh_)) return;
    throw UsageError("found vectors at " + std::to_string(given.size()) + " nodes with " +
                     std::to_string(given.dimension()) + " components, expected " +
                     std::to_string(mesh_.size()) + " with " + std::to_string(mesh_.dimension()));
  }

  void prepare_targets() {
    SmoothingWorkspace& workspace = *equations_.workspace;
    if (!(workspace.options().targets.keep > 0)) return;
    const WallLayers& walls = workspace.walls(equations_.classes, equations_.reference);
    targets_ =
        target_response(form(), workspace,
                        WallStretchDerivative(walls, equations_.solution, equations_.layer_factors),
                        equations_.solution);
  }
  /// The VCVs of held layers were made anew after the motion.
  void prepare_layers(const MeshState& result) {
    const SmoothOptions& options = equations_.workspace->options();
    const auto* plane = dynamic_cast<const VariationalWinslow*>(&form());
    if (!plane || !result.layers || !result.layers->held) return;
    layers_ = layer_response(
        *plane,
        {result, options.targets, *equations_.classes, *equations_.reference, options.threads},
        equations_.solution);
  }
  void prepare_solver() {
    // Preconditioned by what Newton's method left, if it made any step to the solution.
    linear_ = &equations_.workspace->symmetric_linear();
    linear_->set_tolerance(tight);
    std::vector<double> residual(form().unknowns());
    form().linearise(equations_.solution, Curvature::exact, hessian_, residual);
    if (!residual.empty()) linear_->set_matrix(hessian_, true);
  }

  std::vector<double> solve(std::span<const double> rhs) const {
    std::vector<double> out(rhs.size(), 0.0);
    if (rhs.empty() || std::ranges::all_of(rhs, [](double v) { return v == 0; })) return out;
    const std::lock_guard lock(mutex_);
    const LinearResult result = linear_->solve(rhs, 1, out);
    constexpr double enough = 1e-9;
    if (!(result.relative_residual < enough))
      throw NumericError("the linear solver (" + linear_->description() +
                         ") did not converge for the derivative of the mesh: choose another one, "
                         "for example \"direct\"");
    return out;
  }

  MotionEquations equations_;
  Index heights_;
  std::vector<Index> boundary_;
  Coordinates mesh_;
  double distance_ = 0;
  // Null: the targets do not depend on walls, by their stretch and by VCVs of layers.
  std::unique_ptr<const TargetResponse> targets_, layers_;
  SparseMatrix hessian_;
  mutable std::mutex mutex_;        // of the solver
  LinearSolver* linear_ = nullptr;  // of the workspace
};

MeshSensitivity::MeshSensitivity(const MeshState& state, const ResolvedCommand& motion,
                                 const CommandResult& moved, const RunOptions& options)
    : impl_(std::make_unique<const Impl>(state, motion, moved, options)) {}
MeshSensitivity::MeshSensitivity(const MeshState& state, const ResolvedCommand& motion,
                                 const Coordinates& moved, const RunOptions& options)
    : MeshSensitivity(state, motion, result_at(state, motion, moved, options), options) {}
MeshSensitivity::~MeshSensitivity() = default;
MeshSensitivity::MeshSensitivity(MeshSensitivity&&) noexcept = default;
MeshSensitivity& MeshSensitivity::operator=(MeshSensitivity&&) noexcept = default;

const Coordinates& MeshSensitivity::mesh() const { return impl_->mesh(); }
double MeshSensitivity::distance() const { return impl_->distance(); }
const std::vector<Index>& MeshSensitivity::boundary() const { return impl_->boundary(); }
Coordinates MeshSensitivity::forward(const Coordinates& boundary) const {
  return impl_->forward(boundary);
}
Coordinates MeshSensitivity::transpose(const Coordinates& function) const {
  return impl_->transpose(function);
}
MeshSensitivity::Frozen MeshSensitivity::frozen() const { return impl_->frozen(); }
std::string MeshSensitivity::solver() const { return impl_->solver(); }

Coordinates parameter_velocities(const Mesh& moved, const MovingBody& body,
                                 MotionParameter parameter) {
  const int dimension = moved.coordinates.dimension();
  const auto shift = static_cast<int>(parameter) - 1;  // along which axis
  if (shift == 2 && dimension == 2)
    throw UsageError("translate_z: a plane mesh has no third direction");
  if (shift < 0 && !body.motion.pivot)
    throw UsageError("the derivative by an angle needs the pivot of the body");
  const RigidMotion motion = resolve_motion(body.motion, dimension, Vec3::Zero());
  if (shift < 0 && dimension == 3 && !body.motion.axis)
    throw UsageError("the derivative by an angle needs the axis of the body in space");
  Coordinates out(dimension, moved.coordinates.size());
  for (const Index node : moving_nodes(*moved.topology, body.markers)) {
    const Vec3 arm = place_of(moved.coordinates, node) - pivot_of(motion) - Vec3(motion.translate);
    set_place(out, node,
              shift >= 0 ? Vec3(Vec3::Unit(shift))
                         : Vec3(radians(1) * axis_of(motion).normalized().cross(arm)));
  }
  return out;
}

double scalar_product(const Coordinates& a, const Coordinates& b) {
  return std::inner_product(a.values().begin(), a.values().end(), b.values().begin(), 0.0);
}

}  // namespace winslow
