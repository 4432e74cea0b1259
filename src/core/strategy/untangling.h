#pragma once

#include "core/outer/energy_untangler.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run_recorder.h"
#include "core/strategy/workspace.h"

namespace winslow {

/// The part of a run that makes a tangled mesh valid, as SmoothOptions::untangle says.
class Untangling {
 public:
  /// The workspace is prepared. The references outlive this.
  Untangling(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : state_(state), workspace_(workspace), recorder_(recorder) {}

  /// Returns true if x is valid in the end; a valid x stays as it is. reference: a valid mesh of
  /// the same connectivity that says how large the triangles are to be; may be null.
  bool run(Coordinates& x, double fraction, const Coordinates* reference);
  /// Whether run() went by the energy, if only in vain.
  bool tried_energy() const { return tried_energy_; }

 private:
  bool by_picard(Coordinates& x, double fraction);
  bool by_energy(Coordinates& x, double fraction, const Coordinates* reference, Interior interior,
                 const RunRecorder::Enough& enough = {});
  bool guard_inside(const Coordinates& x);
  bool by_harmonic_start(Coordinates& x, double fraction);
  bool by_energy_from_either(Coordinates& x, double fraction, const Coordinates* reference);

  const MeshState& state_;
  SmoothingWorkspace& workspace_;
  RunRecorder& recorder_;
  bool tried_energy_ = false;
};

}  // namespace winslow
