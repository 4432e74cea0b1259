#include <algorithm>

#include "core/formulation/folds.h"
#include "core/formulation/surface_winslow.h"

namespace winslow {

std::vector<bool> SurfaceWinslow::turned_over(const Coordinates& x) const {
  const FlatCells cells = own_planes(x);
  std::vector<bool> turned(cells.planes.size());
  for (std::size_t t = 0; t < turned.size(); ++t) turned[t] = !(cells.determinant(t) > 0);
  return turned;
}

Index SurfaceWinslow::stuck_nodes() const {
  return static_cast<Index>(std::ranges::count(stuck_, true));
}

std::shared_ptr<const EnergyProblem> SurfaceWinslow::holding_stuck_nodes(
    const Coordinates& x, std::span<const double> direction, double step) const {
  const auto rows = node_unknowns().nodes().size();
  Coordinates there = x;
  advance(direction, step, there);
  std::vector<bool> stuck = stuck_.empty() ? std::vector<bool>(rows, false) : stuck_;
  add_nodes_led_astray(node_unknowns(), x, there, direction, 2, step, stuck);
  // Of the nodes of elements that turn over on the way, those that turn one on their own.
  const std::vector<bool> before = turned_over(x), after = turned_over(there);
  for (std::size_t t = 0; t < after.size(); ++t) {
    if (!after[t] || before[t]) continue;
    std::vector<Index> moved;
    bool found = false;
    for (const Index node : structure_->cells[t]) {
      const Index row = structure_->row_of_node[at(node)];
      if (row < 0 || (!stuck_.empty() && stuck_[at(row)])) continue;
      moved.push_back(row);
      std::vector<double> alone(direction.size(), 0.0);
      for (const std::size_t k : {2 * at(row), 2 * at(row) + 1}) alone[k] = direction[k];
      Coordinates y = x;
      advance(alone, step, y);
      if (!turned_over(y)[t]) continue;
      stuck[at(row)] = found = true;
    }
    if (found) continue;
    for (const Index row : moved) stuck[at(row)] = true;
  }
  if (std::ranges::count(stuck, true) == stuck_nodes()) return nullptr;
  auto other = std::make_shared<SurfaceWinslow>(*this);
  other->stuck_ = std::move(stuck);
  return other;
}

}  // namespace winslow
