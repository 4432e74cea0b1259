#pragma once

#include "core/mesh/coordinates.h"
#include "core/outer/energy_untangler.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
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

/// Raises the worst element of a valid mesh as far as it will go: minimises the largest distortion
/// f of any cell from its target, of right-angled corners by their angles alone
/// (VariationalForm::with_corner_lengths()).
///
/// Each round takes a few of Newton's steps on the energy sum w f / (1 - f / bound), which no cell
/// can leave the bound by; then the corners take the lengths of the edges as they are, and the
/// bound comes closer to the largest f that is left. (Interior point; the penalty: V. Garanzha,
/// I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, "On local invertibility and quality
/// of free-boundary deformations", 2022.) The rounds end when they gain nothing worth having, or
/// the budget of the recorder is spent. Every mesh on the way is valid. The one with the largest
/// smallest normalized Jacobian is taken, be it the one that this began with: targets that keep
/// elements stretched measure otherwise. What the result says of convergence stays what it says of
/// the mesh that this began with.
void raise_worst_element(SmoothingWorkspace& workspace, RunRecorder& recorder, double fraction,
                         Coordinates& x);

}  // namespace winslow
