#include "core/inspect/nodal_view.h"

#include <Eigen/SVD>

#include "core/error.h"
#include "core/mesh/surface_faces.h"
#include "core/vcv/sphere/sphere_link.h"

namespace winslow {

namespace {

/// Neighbours of a node of a surface mesh, relative to the node, after its star is laid flat.
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

/// Evaluates the operator at the node of view.physical.
void evaluate(NodalView& view) {
  const std::vector<Vec2>& around = view.physical.points;
  Coordinates x(2, static_cast<Index>(around.size()) + 1);  // the node, then its neighbours
  std::vector<Index> neighbours(around.size());
  std::iota(neighbours.begin(), neighbours.end(), Index{1});
  for (std::size_t k = 0; k < around.size(); ++k) x.set_xy(neighbours[k], around[k]);
  std::vector<NeighbourFunctionals> functionals(neighbours.size());
  compute_functionals(view.vcv.points, functionals);
  view.gradient = nodal_gradient(x, 0, neighbours, functionals);
  view.singular_values = singular_values(view.gradient);
  view.kappa = view.singular_values[1] > 0 ? view.singular_values[0] / view.singular_values[1]
                                           : std::numeric_limits<double>::infinity();
  view.coefficients = winslow_coefficients(view.gradient);
  for (const auto& f : functionals) view.weights.push_back(winslow_weight(view.coefficients, f));
  view.set(evaluate_row(x, 0, neighbours, view.weights));
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

Star make_star(std::vector<Vec2> points) {
  Star star;
  star.points = std::move(points);
  const std::size_t n = star.points.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2& p = star.points[k];
    const Vec2& q = star.points[(k + 1) % n];
    star.lengths.push_back(p.norm());
    star.angles.push_back(turn_between(p, q));
    star.areas.push_back(0.5 * cross(p, q));
  }
  return star;
}

std::array<double, 2> singular_values(const NodalGradient& jacobian) {
  const double squares = jacobian.rx.squaredNorm() + jacobian.ry.squaredNorm();
  const double det = cross(jacobian.rx, jacobian.ry);
  // From (s1 + s2)^2 and (s1 - s2)^2, without cancellation.
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
  std::vector<Vec2> around;
  if (is_surface(topology)) {
    around = flat_star(x, node, neighbours);
  } else {
    view.position = x.xy(node);
    for (const Index k : neighbours) around.push_back(x.xy(k) - view.position);
  }
  view.physical = make_star(std::move(around));
  view.vcv = make_star(vcv_points(vcv.angles(node), vcv.lengths(node)));
  // The given numbers, without the round-off of the points.
  view.vcv.angles.assign(vcv.angles(node).begin(), vcv.angles(node).end());
  view.vcv.lengths.assign(vcv.lengths(node).begin(), vcv.lengths(node).end());
  view.edited = vcv.edited(node);
  evaluate(view);
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

namespace {

Vec3 direction_of(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(0, 0, 0);
}

void fill_operator(VolumeNodalView& view, const Coordinates& x) {
  std::vector<VolumeFunctional> functionals(view.neighbours.size());
  compute_functionals(view.link, view.vcv.points, functionals);
  view.gradient.setZero();
  for (std::size_t k = 0; k < functionals.size(); ++k) {
    const Vec3 share(functionals[k].dx, functionals[k].dy, functionals[k].dz);
    view.gradient += view.physical.points[k] * share.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(view.gradient, Eigen::ComputeFullU);
  view.u = svd.matrixU();
  view.singular_values = svd.singularValues();
  view.kappa = view.singular_values[2] > 0 ? view.singular_values[0] / view.singular_values[2]
                                           : std::numeric_limits<double>::infinity();
  view.tensor = winslow_tensor(view.gradient);
  for (const VolumeFunctional& f : functionals)
    view.weights.push_back(winslow_weight(view.tensor, f));
  view.set(evaluate_row<3>(x, view.node, view.neighbours, view.weights));
}

}  // namespace

SphereStar make_sphere_star(const SphereLink& link, std::vector<Vec3> points) {
  SphereStar star;
  star.points = std::move(points);
  std::vector<Vec3> directions;
  for (const Vec3& p : star.points) {
    star.lengths.push_back(p.norm());
    directions.push_back(direction_of(p));
  }
  for (const auto& [a, b, c] : link.triangles()) {
    star.solid_angles.push_back(
        solid_angle(directions[at(a)], directions[at(b)], directions[at(c)]));
    star.volumes.push_back(star.points[at(a)].dot(star.points[at(b)].cross(star.points[at(c)])) /
                           6);
  }
  return star;
}

VolumeNodalView inspect_node(const Topology& topology, const Coordinates& x, const NodeVcv& vcv) {
  VolumeNodalView view;
  view.node = vcv.node;
  const auto neighbours = topology.neighbours(vcv.node);
  view.neighbours.assign(neighbours.begin(), neighbours.end());
  view.position = x.xyz(vcv.node);
  view.link = vcv.link;
  std::vector<Vec3> around, towards;
  for (const Index k : neighbours) {
    around.push_back(x.xyz(k) - view.position);
    towards.push_back(direction_of(around.back()));
  }
  view.turned_by = fitted_rotation(vcv.stencil.directions, towards);
  view.physical = make_sphere_star(vcv.link, std::move(around));
  std::vector<Vec3> points = vcv.points();
  for (Vec3& p : points) p = view.turned_by * p;
  view.vcv = make_sphere_star(vcv.link, std::move(points));
  view.targets = vcv.targets;
  view.edited = vcv.edited;
  for (std::size_t t = 0; t < view.targets.size(); ++t)
    view.largest_error =
        std::max(view.largest_error, std::abs(view.vcv.solid_angles[t] / view.targets[t] - 1));
  fill_operator(view, x);
  return view;
}

Eigen::Matrix3d fitted_rotation(std::span<const Vec3> from, std::span<const Vec3> to) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) sum += to[k] * from[k].transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

}  // namespace winslow
