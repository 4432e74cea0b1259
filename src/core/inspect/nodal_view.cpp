#include "core/inspect/nodal_view.h"

#include "core/error.h"
#include "core/mesh/surface_faces.h"

namespace winslow {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Neighbours of a node of a surface mesh, relative to it, its star laid flat.
std::vector<Vec2> flat_star(const Coordinates& coordinates, Index node,
                            std::span<const Index> neighbours) {
  const SpacePoints x(coordinates);
  const std::size_t n = neighbours.size();
  std::vector<Vec3> edges;
  for (const Index k : neighbours) edges.emplace_back(x[k] - x[node]);
  std::vector<double> directions{0};
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 &a = edges[k], &b = edges[(k + 1) % n];
    directions.push_back(directions.back() + std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  const double scale = directions.back() > 0 ? 2 * pi / directions.back() : 1;
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < n; ++k)
    points.push_back(edges[k].norm() *
                     Vec2(std::cos(scale * directions[k]), std::sin(scale * directions[k])));
  return points;
}

/// A node with its neighbours as a mesh of their own: the node first.
struct LocalStar {
  Coordinates x;
  std::vector<Index> neighbours;

  explicit LocalStar(const std::vector<Vec2>& around)
      : x(2, static_cast<Index>(around.size()) + 1) {
    x.set_xy(0, Vec2(0, 0));
    for (std::size_t k = 0; k < around.size(); ++k) {
      neighbours.push_back(static_cast<Index>(k) + 1);
      x.set_xy(neighbours.back(), around[k]);
    }
  }
};

/// What the operator makes of a star. node and neighbours: as x has them.
void evaluate(const Coordinates& x, Index node, std::span<const Index> neighbours,
              NodalView& view) {
  std::vector<NeighbourFunctionals> functionals(neighbours.size());
  compute_functionals(view.vcv.points, functionals);
  view.gradient = nodal_gradient(x, node, neighbours, functionals);
  view.singular_values = singular_values(view.gradient);
  view.kappa = view.singular_values[1] > 0 ? view.singular_values[0] / view.singular_values[1]
                                           : std::numeric_limits<double>::infinity();
  view.coefficients = winslow_coefficients(view.gradient);
  for (const auto& f : functionals) view.weights.push_back(winslow_weight(view.coefficients, f));
  const NodalRow row = evaluate_row(x, node, neighbours, view.weights);
  view.smallest_weight = row.smallest_weight(view.weights);
  view.residual = row.residual;
  view.scaled_residual = row.scaled();
}

}  // namespace

void require_inspectable(const Topology& topology, Index node) {
  const std::string who = "node " + std::to_string(node);
  if (node < 0 || node >= topology.node_count()) {
    throw UsageError("the mesh has no " + who + ": its nodes count from 0 to " +
                     std::to_string(topology.node_count() - 1));
  }
  if (!topology.used(node)) throw UsageError(who + " belongs to no element: it has no VCV");
  if (topology.on_boundary(node)) {
    throw UsageError(who + " lies on the boundary or on a marker: it has no VCV");
  }
}

double Star::mean_length() const {
  double sum = 0;
  for (const double length : lengths) sum += length;
  return lengths.empty() ? 0 : sum / static_cast<double>(lengths.size());
}

Star make_star(std::vector<Vec2> points) {
  Star star;
  star.points = std::move(points);
  const std::size_t n = star.points.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2& p = star.points[k];
    const Vec2& q = star.points[(k + 1) % n];
    star.lengths.push_back(p.norm());
    star.angles.push_back(std::atan2(cross(p, q), p.dot(q)));
    star.areas.push_back(0.5 * cross(p, q));
  }
  return star;
}

std::array<double, 2> singular_values(const NodalGradient& jacobian) {
  const double squares = jacobian.rx.squaredNorm() + jacobian.ry.squaredNorm();
  const double det = cross(jacobian.rx, jacobian.ry);
  // (s1 + s2)^2 and (s1 - s2)^2: no root of a difference of large numbers.
  const double sum = std::sqrt(std::max(squares + 2 * std::abs(det), 0.0));
  const double difference = std::sqrt(std::max(squares - 2 * std::abs(det), 0.0));
  return {0.5 * (sum + difference), 0.5 * (sum - difference)};
}

NodalView inspect_node(const VirtualControlVolumes& vcv, const Coordinates& x, Index node) {
  const Topology& topology = vcv.topology();
  require_inspectable(topology, node);
  NodalView view;
  view.node = node;
  const auto neighbours = topology.neighbours(node);
  view.neighbours.assign(neighbours.begin(), neighbours.end());
  const bool surface = is_surface(topology);
  std::vector<Vec2> around;
  if (surface) {
    around = flat_star(x, node, neighbours);
  } else {
    view.position = x.xy(node);
    for (const Index k : neighbours) around.push_back(x.xy(k) - view.position);
  }
  view.physical = make_star(std::move(around));
  view.vcv = make_star(vcv_points(vcv.angles(node), vcv.lengths(node)));
  // The numbers as they were set, rather than worked out from points.
  view.vcv.angles.assign(vcv.angles(node).begin(), vcv.angles(node).end());
  view.vcv.lengths.assign(vcv.lengths(node).begin(), vcv.lengths(node).end());
  view.edited = vcv.edited(node);

  if (surface) {
    const LocalStar flat(view.physical.points);
    evaluate(flat.x, 0, flat.neighbours, view);
  } else {
    evaluate(x, node, neighbours, view);
  }
  return view;
}

StarPlane plane_of_star(const Topology& topology, const Coordinates& x, const NodalView& view) {
  const SpacePoints points(x);
  Vec3 normal = star_normal(topology, points, view.node);
  if (normal.isZero()) normal = Vec3::UnitZ();
  const Vec3 first = normal.unitOrthogonal(), second = normal.cross(first);
  std::vector<Vec2> over;
  for (const Index k : view.neighbours) {
    const Vec3 arm = points[k] - points[view.node];
    over.emplace_back(first.dot(arm), second.dot(arm));
  }
  const double turn = fitted_turn(view.physical, make_star(std::move(over)));
  const double c = std::cos(turn), s = std::sin(turn);
  return {points[view.node], c * first + s * second, c * second - s * first};
}

double fitted_turn(const Star& vcv_star, const Star& physical) {
  double cosine = 0, sine = 0;
  for (std::size_t k = 0; k < vcv_star.points.size(); ++k) {
    const Vec2& v = vcv_star.points[k];
    const Vec2& p = physical.points[k];
    const double size = v.norm() * p.norm();
    if (!(size > 0)) continue;
    cosine += v.dot(p) / size;
    sine += cross(v, p) / size;
  }
  return std::atan2(sine, cosine);
}

}  // namespace winslow
