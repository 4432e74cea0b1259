#include "core/inspect/space/volume_nodal_view.h"

#include <Eigen/SVD>

#include "core/vcv/sphere/sphere_link.h"

namespace winslow {

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
  const auto row = evaluate_row<3>(x, view.node, view.neighbours, view.weights);
  view.smallest_weight = row.smallest_weight(view.weights);
  view.residual = row.residual;
  view.scaled_residual = row.scaled();
}

}  // namespace

double SphereStar::mean_length() const {
  double sum = 0;
  for (const double length : lengths) sum += length;
  return lengths.empty() ? 0 : sum / static_cast<double>(lengths.size());
}

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
