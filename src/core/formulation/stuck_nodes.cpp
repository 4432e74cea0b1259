#include "core/formulation/stuck_nodes.h"

#include <Eigen/Geometry>

#include "core/formulation/surface_winslow.h"
#include "core/formulation/variational_winslow.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// The surface turns between two feet by more than a fold at least does.
bool turns(const Foot& from, const Foot& to) {
  const double cos_fold = std::cos(10 * M_PI / 180);
  const int count = std::min(from.frame.count(), to.frame.count());
  if (count == 0) return false;
  if (count == 1) return std::abs(from.frame[0].dot(to.frame[0])) < cos_fold;
  const Vec3 before = from.frame[0].cross(from.frame[1]);
  return std::abs(before.dot(to.frame[0].cross(to.frame[1]))) < cos_fold;
}

/// way: length of the step in the tangent plane.
bool leads_astray(const NodeClasses& classes, Index node, const Foot& from, const Foot& to,
                  double way) {
  constexpr double far = 4;
  constexpr int halvings = 6;
  if ((to.point - from.point).norm() > far * way) return true;
  Foot first = from, last = to;
  for (int i = 0; i < halvings && turns(first, last); ++i) {
    const Foot middle = classes.foot(node, 0.5 * (first.point + last.point));
    (turns(first, middle) ? last : first) = middle;
  }
  return turns(first, last);
}

}  // namespace

Index add_nodes_led_astray(const NodeUnknowns& nodes, const Coordinates& x,
                           const Coordinates& there, std::span<const double> direction,
                           std::size_t stride, double step, std::vector<bool>& stuck) {
  const NodeClasses& classes = nodes.classes();
  const SpacePoints before(x), after(there);
  std::vector<unsigned char> astray(stuck.size(), 0);
  constexpr Index block = 512;  // a foot may take a search
  const auto find = [&](Index begin, Index end) {
    for (std::size_t row = at(begin); row < at(end); ++row) {
      const Index node = nodes.nodes()[row];
      if (stuck[row] || !classes.slides(node)) continue;
      const auto of_node = direction.subspan(stride * row, stride);
      const double way = step * std::hypot(of_node[0], of_node[1]);
      if (!(way > 0)) continue;
      const Foot from = classes.foot(node, before[node]), to = classes.foot(node, after[node]);
      astray[row] = leads_astray(classes, node, from, to, way) ? 1 : 0;
    }
  };
  parallel_for(nodes.threads(), static_cast<Index>(stuck.size()), find, block);
  Index count = 0;
  for (std::size_t row = 0; row < stuck.size(); ++row) {
    if (astray[row] == 0) continue;
    stuck[row] = true;
    ++count;
  }
  return count;
}

std::vector<bool> SurfaceWinslow::turned_over(const Coordinates& x) const {
  const FlatCells cells = own_planes(x);
  std::vector<bool> turned(cells.planes.size());
  for (std::size_t t = 0; t < turned.size(); ++t) turned[t] = !(cells.determinant(t) > 0);
  return turned;
}

bool SurfaceWinslow::turned_over(std::size_t cell, const Coordinates& coordinates) const {
  const SpacePoints x(coordinates);
  const auto& nodes = structure_->cells[cell];
  const Vec3 u = x[nodes[1]] - x[nodes[0]], v = x[nodes[2]] - x[nodes[0]];
  const Vec3 reference = node_unknowns().classes().sliding().element_normals()->of_element(
      structure_->element[cell], coordinates);
  return !(determinant_in(own_plane(u, v, reference), u, v) > 0);
}

/// Adds to `stuck` (#rows) those nodes of a cell which turn it over when they alone go from x to
/// `there`; all of its nodes that move if none does so alone. y: x, changed and put back.
void SurfaceWinslow::add_nodes_that_turn(std::size_t cell, const Coordinates& x,
                                         const Coordinates& there, Coordinates& y,
                                         std::vector<bool>& stuck) const {
  const NodeClasses& classes = node_unknowns().classes();
  const auto around = topology().element(structure_->element[cell]);
  for (const Index node : around)
    if (classes.slides(node)) y.set_xyz(node, classes.foot(node, x.xyz(node)).point);
  std::vector<Index> moved;
  bool found = false;
  for (const Index node : structure_->cells[cell]) {
    const Index row = structure_->row_of_node[at(node)];
    if (row < 0 || (!stuck_.empty() && stuck_[at(row)])) continue;
    moved.push_back(row);
    const Vec3 stays = y.xyz(node);
    y.copy_node(node, there);
    if (turned_over(cell, y)) stuck[at(row)] = found = true;
    y.set_xyz(node, stays);
  }
  if (!found)
    for (const Index row : moved) stuck[at(row)] = true;
  for (const Index node : around) y.copy_node(node, x);
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
  Coordinates y = x;
  for (std::size_t t = 0; t < after.size(); ++t)
    if (after[t] && !before[t]) add_nodes_that_turn(t, x, there, y, stuck);
  if (std::ranges::count(stuck, true) == stuck_nodes()) return nullptr;
  auto other = std::make_shared<SurfaceWinslow>(*this);
  other->stuck_ = std::move(stuck);
  return other;
}

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
