#pragma once

#include "core/command/command.h"
#include "core/command/run_recorder.h"
#include "core/command/workspace.h"

namespace winslow {

/// Smooths by the variational form: untangles where needed, then Newton's method; follows the path
/// where the boundary moves.
class VariationalRun {
 public:
  /// The workspace is prepared. The references outlive the run.
  VariationalRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : state_(state), workspace_(workspace), recorder_(recorder) {}

  /// The boundary stays. reference: a valid mesh of the same connectivity that says how large the
  /// triangles are to be while they are untangled; may be null.
  void smooth(Coordinates& x, double fraction, const Coordinates* reference);
  /// Moves the boundary from x (any mesh; where the motion begins) along a path of valid meshes.
  /// Stops at the last one if it leads no further.
  void follow(const Motion& motion, const Coordinates& rest, Coordinates& x);
  /// Moves the boundary in equal steps, each at once.
  void move_in_steps(const Motion& motion, const Coordinates& rest, int increments, Coordinates& x);

 private:
  bool untangle(Coordinates& x, double fraction, const Coordinates* reference);
  bool untangle_by_picard(Coordinates& x, double fraction);
  bool untangle_by_energy(Coordinates& x, double fraction, const Coordinates* reference);
  void relax(Coordinates& x, double fraction);
  void approach(Coordinates& x, double fraction);
  void converge(Coordinates& x, double fraction);

  const MeshState& state_;
  SmoothingWorkspace& workspace_;
  RunRecorder& recorder_;
};

}  // namespace winslow
