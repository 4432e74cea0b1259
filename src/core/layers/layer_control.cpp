#include "core/layers/layer_control.h"

namespace winslow {

namespace {

/// Scales angles to a sum of 360 degrees, with none above `most`.
void fill_circle(std::vector<double>& angles, double most) {
  const double scale = 2 * pi / std::accumulate(angles.begin(), angles.end(), 0.0);
  double above = 0, below = 0;
  for (double& angle : angles) {
    angle *= scale;
    if (angle > most) {
      above += angle - most;
      angle = most;
    } else {
      below += angle;
    }
  }
  if (above == 0) return;
  for (double& angle : angles) {
    if (angle < most) angle *= 1 + above / below;
  }
}

/// Corners of quadrilaterals within this angle (radians) of a right angle become right angles.
constexpr double nearly_right = radians(10);

/// Angles and lengths of the VCVs of layers' nodes.
class Stencils {
 public:
  Stencils(const Topology& topology, const LayerStack& stack, const Coordinates& x)
      : topology_(topology), stack_(stack), straight_(straight_columns(stack, x)) {}

  /// Angles at a node. Corners of quadrilaterals have right angles if those of straight columns are
  /// nearly right; other corners (where the wall turns, in fans, in triangles), and all corners of
  /// columns with a course of their own, have the angles of straight_. The elements outside share
  /// the rest of the circle.
  std::vector<double> angles(Index node, bool own_course) const {
    const auto row = topology_.neighbours(node);
    const auto star = topology_.star(node);
    std::vector<double> angles;
    double inside = 0;
    std::size_t outside = 0;
    for (std::size_t k = 0; k < star.size(); ++k) {
      const Index a = row[k], b = row[(k + 1) % row.size()];
      double angle = 0;
      if (!in_layers(k, star)) {
        ++outside;
      } else {
        const Vec2 p = straight_.xy(node);
        angle = std::abs(turn_between(straight_.xy(a) - p, straight_.xy(b) - p));
        const bool quad = topology_.element_type(star[k]) == ElementType::quadrilateral;
        if (quad && !own_course && std::abs(angle - pi / 2) < nearly_right) angle = pi / 2;
      }
      inside += angle;
      angles.push_back(angle);
    }
    if (outside > 0) {
      const double least = own_course ? 1e-3 : pi / 6;
      const double share = std::max(least, (2 * pi - inside) / static_cast<double>(outside));
      std::replace(angles.begin(), angles.end(), 0.0, share);
    }
    fill_circle(angles, own_course ? 0.999 * pi : 0.9 * pi);
    return angles;
  }

  /// Lengths at the node of a column at a level (1: first above the wall). Edges outside the layers
  /// have the mean length of the edges along the rim.
  std::vector<double> lengths(const LayerColumn& column, std::size_t level) const {
    const Index node = column.nodes[level];
    const auto row = topology_.neighbours(node);
    const auto star = topology_.star(node);
    std::vector<double> lengths;
    double sideways = 0;
    int sides = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      double length = 0;
      if (row[k] == column.nodes[level - 1]) {
        length = height(column, level - 1);
      } else if (level < column.count() && row[k] == column.nodes[level + 1]) {
        length = height(column, level);
      } else if (in_layers(k, star) || in_layers(k + star.size() - 1, star)) {
        length = (straight_.xy(row[k]) - straight_.xy(node)).norm();
        sideways += length;
        ++sides;
      }
      lengths.push_back(length);
    }
    std::replace(lengths.begin(), lengths.end(), 0.0, sides > 0 ? sideways / sides : 1.0);
    return lengths;
  }

 private:
  bool in_layers(std::size_t k, std::span<const Index> star) const {
    return stack_.layer_of_element[at(star[k % star.size()])] >= 0;
  }
  static double height(const LayerColumn& column, std::size_t layer) {
    return wanted_length(column, layer) *
           (column.corrections.empty() ? 1 : column.corrections[layer]);
  }

  const Topology& topology_;
  const LayerStack& stack_;
  Coordinates straight_;
};

}  // namespace

std::shared_ptr<const VirtualControlVolumes> layer_vcvs(
    const std::shared_ptr<const Topology>& topology, const LayerStack& stack,
    const VirtualControlVolumes& base, const Coordinates& x) {
  require_plane(*topology, "virtual control volumes");
  VirtualControlVolumes vcv(topology);
  for (const auto& [node, stencil] : base.edits()) {
    if (node >= topology->node_count() || topology->on_boundary(node)) continue;
    if (topology->neighbours(node).size() != stencil.angles.size()) continue;
    vcv.set(node, stencil.angles, stencil.lengths);
  }
  const Stencils stencils(*topology, stack, x);
  for (const LayerColumn& column : stack.columns) {
    for (std::size_t k = 1; k < column.nodes.size(); ++k) {
      const Index node = column.nodes[k];
      if (topology->on_boundary(node)) continue;
      vcv.set(node, stencils.angles(node, !column.bends.empty()), stencils.lengths(column, k));
    }
  }
  return std::make_shared<const VirtualControlVolumes>(std::move(vcv));
}

std::shared_ptr<const ElementRoles> layer_roles(const Topology& topology, const LayerStack& stack) {
  auto roles = std::make_shared<ElementRoles>(at(topology.element_count()), ElementRole::ordinary);
  std::vector<bool> found(at(topology.node_count()), false);
  for (const LayerColumn& column : stack.columns) {
    if (column.bends.empty()) continue;
    for (std::size_t k = 1; k < column.nodes.size(); ++k) found[at(column.nodes[k])] = true;
  }
  for (std::size_t e = 0; e < roles->size(); ++e) {
    if (stack.layer_of_element[e] < 0) continue;
    const auto nodes = topology.element(static_cast<Index>(e));
    const bool any = std::ranges::any_of(nodes, [&](Index node) { return found[at(node)]; });
    (*roles)[e] = any ? ElementRole::found_layer : ElementRole::layer;
  }
  const auto keep_outside = [&](Index node) {
    for (const Index e : topology.star(node))
      if (stack.layer_of_element[at(e)] < 0) (*roles)[at(e)] = ElementRole::beside_layers;
  };
  for (const LayerColumn& column : stack.columns) {
    keep_outside(column.rim());
    // Neighbours of a column that was found may have fewer layers.
    if (!column.bends.empty()) std::ranges::for_each(column.nodes, keep_outside);
  }
  return roles;
}

void correct_layers(LayerStack& stack, const Coordinates& x) {
  for (LayerColumn& column : stack.columns) {
    column.corrections.resize(column.count(), 1.0);
    for (std::size_t k = 0; k < column.count(); ++k) {
      const double realised = (x.xy(column.nodes[k + 1]) - x.xy(column.nodes[k])).norm();
      column.corrections[k] *= wanted_length(column, k) / realised;
    }
  }
}

}  // namespace winslow
