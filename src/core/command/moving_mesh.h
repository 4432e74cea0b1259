#pragma once

#include "core/command/command.h"
#include "core/strategy/run.h"

/// A mesh whose bodies move again and again, as in the time loop of a flow solver. Every place is
/// told from the mesh as it was given, and the last mesh is where the solver begins:
///
///     winslow::MovingMesh moving(state);
///     winslow::MoveCommand move;
///     move.bodies[0].markers = {"flap"};
///     for (const double angle : {-1.0, -2.0, -3.0, -2.0, -1.0}) {
///       move.bodies[0].motion.rotate = angle;  // from the mesh as given, not from the last one
///       const winslow::CommandResult now = moving.to(move);
///     }
namespace winslow {

/// The mesh of a place is the same whatever way led there, to within the tolerances: elements
/// strive for the shapes that they have in the mesh as given, so that nothing drifts, and a body
/// that is back where it was finds the mesh that it had. Steps are cheaper than commands one by
/// one: a step begins from the last mesh, and targets, patterns and orderings are kept
/// (SolverCache).
///
/// One call at a time. A call that throws, Cancelled included, changes nothing: the last mesh is
/// the one of the call before.
class MovingMesh {
 public:
  explicit MovingMesh(MeshState given) : given_(std::move(given)) {}

  /// What the command makes of the mesh as given. Where no way leads there from the last mesh, that
  /// from the mesh as given is tried. options: `start` and `cache` are this object's. The result is
  /// where the next call begins if it is valid, complete and of the same elements. Throws as
  /// execute() does.
  CommandResult to(const ResolvedCommand& command, RunOptions options = {});

  const MeshState& given() const { return given_; }

 private:
  std::optional<CommandResult> from_last(const ResolvedCommand& command,
                                         const RunOptions& options) const;

  MeshState given_;
  std::optional<Coordinates> last_;  // valid; none: the mesh as given
  SolverCache cache_;
};

}  // namespace winslow
