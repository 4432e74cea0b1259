#include "core/command/untangling.h"

#include <vector>

#include "core/outer/energy_untangler.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

/// Stops a fixed-point iteration that no longer untangles anything. A boundary moved at once
/// inverts few elements at first, and spreads: only later does the count tell.
class Stagnation {
 public:
  bool operator()(const IterationRecord& record) {
    constexpr std::size_t window = 40;
    constexpr double worthwhile = 0.8;  // of the count a window ago
    constexpr double settled = 1e-4;
    if (record.inverted == 0) return true;
    counts_.push_back(record.inverted);
    if (record.residual < settled) return true;
    return counts_.size() > 2 * window &&
           counts_.back() > worthwhile * counts_[counts_.size() - 1 - window];
  }

 private:
  std::vector<Index> counts_;
};

}  // namespace

bool Untangling::by_picard(Coordinates& x, double fraction) {
  constexpr int limit = 150;
  return recorder_.iterate(workspace_.picard(), x, Stage::picard, fraction, limit, Stagnation())
             .inverted == 0;
}

bool Untangling::by_energy(Coordinates& x, double fraction, const Coordinates* reference) {
  constexpr int limit = 200;
  // Winslow's own functional: without a barrier, a steep penalty would only stiffen the system.
  workspace_.energy().set_penalty({1, 0});
  EnergyUntangler untangler(*state_.mesh.topology, workspace_.energy(),
                            workspace_.symmetric_linear(), workspace_.options(), reference);
  recorder_.iterate(untangler, x, Stage::untangle, fraction, limit);
  workspace_.energy().set_penalty(workspace_.options().penalty);
  return untangler.converged();
}

bool Untangling::run(Coordinates& x, double fraction, const Coordinates* reference) {
  const Topology& topology = *state_.mesh.topology;
  const int threads = workspace_.options().threads;
  if (check_validity(topology, x, threads).inverted == 0) return true;
  const Untangle how = workspace_.options().untangle;
  const Coordinates start = x;
  if (how != Untangle::energy && by_picard(x, fraction)) return true;
  if (how == Untangle::picard) return false;
  if (by_energy(x, fraction, reference)) return true;
  if (how == Untangle::energy) return false;
  // Where the fixed point leads astray, the energy alone may do better from the start itself.
  Coordinates other = start;
  if (!by_energy(other, fraction, reference)) {
    recorder_.result().inverted = check_validity(topology, x, threads).inverted;
    return false;
  }
  x = std::move(other);
  return true;
}

}  // namespace winslow
