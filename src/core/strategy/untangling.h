#pragma once

#include "core/mesh/coordinates.h"
#include "core/outer/energy_untangler.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/workspace.h"

namespace winslow {

/// Makes a tangled mesh valid at the start of a run, by the method of SmoothOptions::untangle.
class Untangling {
 public:
  /// The workspace is prepared. The references outlive this.
  Untangling(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : state_(state), workspace_(workspace), recorder_(recorder) {}

  /// Returns true if x is valid afterwards; a valid x stays unchanged. reference: a valid mesh of
  /// the same connectivity that gives the sizes of the elements; may be null.
  bool run(Coordinates& x, double fraction, const Coordinates* reference);
  /// Whether run() tried the energy, successfully or not.
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

/// When raise_worst_element() may stop, besides its own rule.
struct RaiseLimits {
  double enough = 2;  ///< minimum of the normalized Jacobian; no mesh has the default
  int rounds = std::numeric_limits<int>::max();
};

/// Improves the worst element of a valid mesh as far as possible: minimises the largest distortion
/// f of any cell from its target. For right-angled corners only the angles count
/// (VariationalForm::with_corner_lengths()).
///
/// Each round makes a few Newton steps on the energy sum w f / (1 - f / bound), which keeps every
/// cell within the bound. Then the corner targets adopt the present edge lengths, and the bound
/// moves closer to the largest remaining f. (Interior point; the penalty: V. Garanzha, I. Kaporin,
/// L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, "On local invertibility and quality of
/// free-boundary deformations", 2022.) The rounds end when the gain is negligible, or the budget of
/// the recorder is spent. Every mesh on the way is valid. The result is the one with the largest
/// minimum of the normalized Jacobian, possibly the initial mesh: targets that keep elements
/// stretched rate meshes differently. The convergence data in the result stay those of the initial
/// mesh.
void raise_worst_element(SmoothingWorkspace& workspace, RunRecorder& recorder, double fraction,
                         Coordinates& x, const RaiseLimits& limits = {});

}  // namespace winslow
