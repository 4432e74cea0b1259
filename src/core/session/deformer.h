#pragma once

#include "core/command/command.h"
#include "core/sensitivity/mesh_sensitivity.h"

/// A mesh whose boundary moves many times, as in the time loop of a flow solver or of a structural
/// solver that it is coupled to. Every boundary refers to the mesh as given; every step starts from
/// the steps before it:
///
///     winslow::Deformer deformer(state);
///     for (int step = 0; step < steps; ++step) {
///       deformer.set_boundary(nodes, places);  // or set_motion(), set_shape()
///       const winslow::CommandResult now = deformer.step(1e-4);
///       if (now.smooth.fraction_reached < 1) break;  // winslow::why_incomplete(now.smooth)
///       mesh = now.state.mesh;  // for the flow solver
///     }
namespace winslow {

/// Options of all steps.
struct DeformerOptions {
  /// threads: 0 stands for all cores, in a process that MPI has started with others for one
  /// (thread_count()).
  SmoothOptions smooth = {};
  MotionOptions how = {};
  SlideFiles files = {};  ///< what smooth.slide names
};

/// To within the tolerances, the mesh depends only on where the boundary is, not on the way to it.
/// The targets are the element shapes of the mesh as given, so errors do not accumulate, and a
/// boundary that returns to an earlier place gets the earlier mesh. A step predicts its mesh from
/// those of earlier steps (NewtonRun::start_near()), corrects it by Newton's method, and reuses
/// targets, patterns, orderings and hierarchies (SolverCache). If nothing leads there from the last
/// mesh, it goes the way from the mesh as given.
///
/// A deformer has no state outside itself. One call at a time; two deformers may work at once in
/// two threads. A call that throws, Cancelled included, changes nothing.
class Deformer {
 private:
  /// The motion of the present mesh, and its result.
  struct Reached {
    ResolvedCommand command;
    CommandResult result;
  };

 public:
  /// given: the mesh to which all boundaries refer.
  explicit Deformer(MeshState given);
  Deformer(MeshState given, DeformerOptions options);
  ~Deformer();
  Deformer(Deformer&&) noexcept;
  Deformer& operator=(Deformer&&) noexcept;

  // Each of these replaces what was set before; step() checks it.

  /// Bodies move rigidly from where they are in the mesh as given; one without a pivot turns about
  /// its own centre there.
  void set_motion(std::vector<MovingBody> bodies);
  /// Markers change their shape; see DeformCommand.
  void set_shape(std::vector<std::string> markers,
                 std::variant<SineDeformation, DisplacementTable, PositionTable> shape);
  /// Nodes go to these places (#nodes by 2 or 3); all other nodes of the boundary are where they
  /// are in the mesh as given, or slide. Throws UsageError for another number of places or of
  /// components.
  void set_boundary(std::span<const Index> nodes, const Coordinates& places);

  /// Takes the mesh to the boundary that was set. tolerance: of the largest scaled residual, about
  /// the distance of a node from its place in the solution as a share of its edges; 0: that of the
  /// options, 1e-10 if they have none. For a flow solver 1e-4 is enough: errors do not add up.
  ///
  /// If no valid mesh has this boundary, the result is the last valid one on the way there
  /// (SmoothResult::fraction_reached), and the deformer stays at the mesh of the step before.
  /// Throws UsageError if no boundary was set, and as execute() does. monitor: may cancel.
  CommandResult step(double tolerance = 0, SolverMonitor* monitor = nullptr);

  const MeshState& given() const { return given_; }
  /// The mesh of the last complete step; before the first one, that given.
  const std::shared_ptr<const Coordinates>& coordinates() const;
  /// The way of each node in the last complete step (#nodes by 2 or 3). Divided by the time step it
  /// is the mean velocity of the mesh in that step.
  Coordinates displacement() const;

  /// The derivative of the present mesh by its boundary. Made at the first call after a step: the
  /// mesh is solved to 1e-10 for it. Throws as MeshSensitivity does, and UsageError before the
  /// first step.
  /// It remains that of this mesh when the session goes on. monitor: may cancel.
  std::shared_ptr<const MeshSensitivity> sensitivity(SolverMonitor* monitor = nullptr);
  /// The velocities of all nodes at the present mesh if the nodes of its boundary move at these
  /// velocities (#nodes by 2 or 3; those of nodes that depend on the boundary are not read). One
  /// linear solve, and what sensitivity() costs at the first call after a step:
  /// sensitivity()->forward().
  Coordinates velocities(const Coordinates& boundary) { return sensitivity()->forward(boundary); }
  /// Largest share (0 to 1) of the way of the boundary to these places (#nodes by 2 or 3, as for
  /// velocities()) for which the mesh is valid to first order: a bound for the next time step.
  /// Costs what velocities() costs. step() goes farther where it can.
  double largest_valid(const Coordinates& places);

  /// What the next steps depend on.
  class Checkpoint {
    friend class Deformer;
    std::vector<std::shared_ptr<const Coordinates>> last;
    std::vector<MovingBody> bodies;
    std::shared_ptr<const Reached> reached;
  };
  /// For implicit coupling, which repeats time steps. The steps after restore() give the results,
  /// bit for bit, that the same steps gave after checkpoint(). Solvers are prepared anew after each
  /// of both, since iterative ones remember earlier matrices; patterns, targets and control volumes
  /// are kept.
  Checkpoint checkpoint();
  /// checkpoint: of this object.
  void restore(const Checkpoint& checkpoint);

 private:
  ResolvedCommand next(double tolerance) const;
  std::optional<CommandResult> from_last(const ResolvedCommand& command,
                                         const RunOptions& options) const;

  MeshState given_;
  DeformerOptions options_;
  std::shared_ptr<const Coordinates> given_coordinates_;
  std::optional<Command> set_;              // with the options of the session; none: nothing is set
  std::shared_ptr<const Reached> reached_;  // null: the present mesh is that given
  // The results of the last complete steps, the latest first.
  std::vector<std::shared_ptr<const Coordinates>> last_;
  std::vector<MovingBody> bodies_;  // moved in the last result, with pivots; empty: not known
  SolverCache cache_;
  std::shared_ptr<const MeshSensitivity> sensitivity_;  // of the present mesh; null: not made
};

}  // namespace winslow
