#include "core/vcv/stencil_functionals.h"

#include <cmath>

#include "core/error.h"

namespace winslow {

namespace {

/// The VCV of a node with two edges (two quadrilaterals that share both) has no area. The node gets
/// the gradient along its edge line and equal weights, so it ends halfway between its neighbours.
/// So does a hanging node, between its neighbours on the side of the polygon.
void two_edge_functionals(NeighbourFunctionals& first, NeighbourFunctionals& second) {
  first = {0.5, 0, 0, 0, 1};
  second = {-0.5, 0, 0, 0, 1};
}

/// Two edges of the VCV that lie on one line with the node between them; none if there is no such
/// pair, or if another triangle has no area.
std::optional<std::size_t> straight_part(std::span<const Vec2> points) {
  constexpr double round_off = 1e-9;
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec2 &p = points[k], &q = points[(k + 1) % points.size()];
    if (cross(p, q) > round_off * p.norm() * q.norm()) continue;
    if (found || !(p.dot(q) < 0)) return std::nullopt;
    found = k;
  }
  return found;
}

}  // namespace

void compute_functionals(std::span<const Vec2> points, std::span<NeighbourFunctionals> out) {
  const std::size_t n = points.size();
  std::fill(out.begin(), out.end(), NeighbourFunctionals{});
  if (n == 2) {
    two_edge_functionals(out[0], out[1]);
    return;
  }
  if (const auto k = straight_part(points)) {
    two_edge_functionals(out[*k], out[(*k + 1) % n]);
    return;
  }
  double area2 = 0;  // twice the area of the VCV
  for (std::size_t t = 0; t < n; ++t) {
    const std::size_t u = (t + 1) % n;
    const Vec2& p = points[t];
    const Vec2& q = points[u];
    const double triangle2 = cross(p, q);
    if (!(triangle2 > 0)) throw NumericError("a VCV triangle has no area");
    area2 += triangle2;
    // Linear interpolation: grad r = [(r_t - r_0) a + (r_u - r_0) b] / (2 area).
    const Vec2 a(q.y(), -q.x());
    const Vec2 b(-p.y(), p.x());
    const Vec2 normal(q.y() - p.y(), p.x() - q.x());
    const auto add = [&](NeighbourFunctionals& f, const Vec2& g) {
      f.dx += g.x();
      f.dy += g.y();
      f.lxx += normal.x() * g.x() / triangle2;
      f.lxy += (normal.x() * g.y() + normal.y() * g.x()) / triangle2;
      f.lyy += normal.y() * g.y() / triangle2;
    };
    add(out[t], a);
    add(out[u], b);
  }
  for (auto& f : out) {
    f.dx /= area2;
    f.dy /= area2;
  }
}

std::vector<Vec2> vcv_points(std::span<const double> angles, std::span<const double> lengths) {
  std::vector<Vec2> points(angles.size());
  double phi = 0;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    points[k] = lengths[k] * Vec2(std::cos(phi), std::sin(phi));
    phi += angles[k];
  }
  return points;
}

StencilFunctionals::StencilFunctionals(const VirtualControlVolumes& vcv)
    : topology_(vcv.shared_topology()) {
  const auto row_of = [&](Index node) {
    const std::vector<Vec2> points = vcv_points(vcv.angles(node), vcv.lengths(node));
    Row row(points.size());
    compute_functionals(points, row);
    return row;
  };
  std::size_t longest = 0;
  for (Index node = 0; node < topology_->node_count(); ++node) {
    longest = std::max(longest, topology_->neighbours(node).size());
  }
  zero_.assign(longest, NeighbourFunctionals{});
  equal_.resize(longest + 1);
  for (const Index node : topology_->interior_nodes()) {
    if (vcv.edited(node) || vcv.hangs(node)) {
      own_[node] = row_of(node);
      continue;
    }
    Row& equal = equal_[topology_->neighbours(node).size()];
    if (equal.empty()) equal = row_of(node);
  }
}

}  // namespace winslow
