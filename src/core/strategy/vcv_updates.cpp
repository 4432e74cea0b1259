#include "core/strategy/vcv_updates.h"

#include <algorithm>
#include <utility>

#include "core/quality/quality.h"

namespace winslow {

namespace {

/// How often, at most.
int most_updates(const Coordinates& given, const SmoothingWorkspace& workspace) {
  constexpr int after_tangle = 10;  // the angles halve their distance to the last ones each time
  const SmoothOptions& options = workspace.options();
  const Topology& topology = workspace.classes().topology();
  if (topology.cell_dimension() != 3 || !refers_to_vcvs(options) || !follows_mesh(options.vcv))
    return 0;
  const bool tangled = check_validity(topology, given, options.threads).inverted > 0;
  return tangled ? std::max(after_tangle, options.vcv_updates) : options.vcv_updates;
}

}  // namespace

void update_vcvs(const Coordinates& given, SmoothingWorkspace& workspace, RunRecorder& recorder,
                 const std::function<void(Coordinates&)>& solve, Coordinates& x) {
  const SmoothResult& result = recorder.result();
  if (!result.converged || result.fraction_reached < 1 || !result.limited_by.empty()) return;
  const int most = most_updates(given, workspace);
  for (int update = 0; update < most && recorder.remaining() > 0; ++update) {
    if (workspace.adjust_vcvs(x) == 0) return;
    Coordinates solution = x;
    const SmoothResult outcome = result;
    solve(x);
    // The operator's own solution may be tangled: from there the next angles are to lead out of it.
    if (result.converged && result.inverted <= outcome.inverted) continue;
    x = std::move(solution);
    recorder.restore_outcome(outcome);
    return;
  }
}

}  // namespace winslow
