#pragma once

#include "core/command/command.h"
#include "core/strategy/run.h"

/// A mesh whose bodies move many times, as in the time loop of a flow solver. Every motion is
/// relative to the mesh as given; the solver starts from the last mesh:
///
///     winslow::MovingMesh moving(state);
///     winslow::MoveCommand move;
///     move.bodies[0].markers = {"flap"};
///     for (const double angle : {-1.0, -2.0, -3.0, -2.0, -1.0}) {
///       move.bodies[0].motion.rotate = angle;  // from the mesh as given, not from the last one
///       const winslow::CommandResult now = moving.to(move);
///     }
namespace winslow {

/// To within the tolerances, the mesh depends only on the position of the bodies, not on the path
/// to it. The targets are the element shapes of the mesh as given, so errors do not accumulate, and
/// a body that returns to an earlier position gets the earlier mesh. A step is cheaper than a
/// separate command: it starts from the last meshes and reuses targets, patterns and orderings
/// (SolverCache). Steps as small as those of a time loop are extrapolated from the last ones and
/// need one linear solve, or two.
///
/// One call at a time. A call that throws, Cancelled included, changes nothing: the last mesh
/// remains that of the previous call.
class MovingMesh {
 public:
  explicit MovingMesh(MeshState given) : given_(std::move(given)) {}

  /// Returns the result of the command on the mesh as given. Without a tolerance of its own the
  /// command is solved to 1e-10, volume meshes as well. If the solver finds no valid path from
  /// the last mesh, it starts from the mesh as given. options: this object sets `start` and
  /// `cache`. The next call starts from the result if that is valid, complete and of the same
  /// elements. Throws as execute() does.
  CommandResult to(const ResolvedCommand& command, RunOptions options = {});

  const MeshState& given() const { return given_; }

  /// What the next result depends on besides the command.
  class Checkpoint {
    friend class MovingMesh;
    std::vector<std::shared_ptr<const Coordinates>> last;
    std::vector<MovingBody> bodies;
  };
  /// For implicit coupling, which repeats time steps. The calls of to() after restore() give the
  /// results, bit for bit, that the same calls gave after checkpoint(). Solvers are prepared anew
  /// after each of both, since iterative ones remember earlier matrices; patterns, targets and
  /// control volumes are kept.
  Checkpoint checkpoint();
  /// checkpoint: of this object.
  void restore(const Checkpoint& checkpoint);

 private:
  std::optional<CommandResult> from_last(const ResolvedCommand& command,
                                         const RunOptions& options) const;

  MeshState given_;
  // The last results, valid, the latest first; empty: the mesh as given.
  std::vector<std::shared_ptr<const Coordinates>> last_;
  std::vector<MovingBody> bodies_;  // moved in the last result, with pivots; empty: not known
  SolverCache cache_;
};

}  // namespace winslow
