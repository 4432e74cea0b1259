#include <algorithm>

#include "core/formulation/folds.h"
#include "core/formulation/variational_winslow.h"

namespace winslow {

template <int D>
Index SimplexWinslow<D>::stuck_nodes() const {
  return static_cast<Index>(std::ranges::count(stuck_, true));
}

/// Of a plane mesh none: the curves that its nodes slide on have no folds but at corners, which
/// stay.
template <>
std::shared_ptr<const EnergyProblem> SimplexWinslow<2>::holding_stuck_nodes(
    const Coordinates& /*x*/, std::span<const double> /*direction*/, double /*step*/) const {
  return nullptr;
}

template <>
std::shared_ptr<const EnergyProblem> SimplexWinslow<3>::holding_stuck_nodes(
    const Coordinates& x, std::span<const double> direction, double step) const {
  const NodeUnknowns& nodes = node_unknowns();
  Coordinates there = x;
  advance(direction, step, there);
  std::vector<bool> stuck =
      stuck_.empty() ? std::vector<bool>(nodes.nodes().size(), false) : stuck_;
  if (add_nodes_led_astray(nodes, x, there, direction, 3, step, stuck) == 0) return nullptr;
  auto other = std::make_shared<SimplexWinslow>(*this);
  other->stuck_ = std::move(stuck);
  return other;
}

template Index SimplexWinslow<2>::stuck_nodes() const;
template Index SimplexWinslow<3>::stuck_nodes() const;

}  // namespace winslow
