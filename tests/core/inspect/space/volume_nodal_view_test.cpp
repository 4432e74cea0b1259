#include "core/inspect/space/volume_nodal_view.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "core/error.h"
#include "core/formulation/pointwise_winslow.h"
#include "core/inspect/nodal_view.h"
#include "core/vcv/sphere/volume_vcvs.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// The node's own star as its VCV, turned and stretched by a linear map.
NodeVcv mapped_star(const Mesh& mesh, Index node, const Eigen::Matrix3d& map) {
  NodeVcv vcv = make_node_vcv(*mesh.topology, mesh.coordinates, node, {});
  const auto neighbours = mesh.topology->neighbours(node);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec3 p = map * (mesh.coordinates.xyz(neighbours[k]) - mesh.coordinates.xyz(node)).eval();
    vcv.stencil.directions[k] = p.normalized();
    vcv.stencil.lengths[k] = p.norm();
  }
  return vcv;
}

}  // namespace

TEST_CASE("an inspection shows the weights, the gradient and the residual of the pointwise form") {
  const Mesh mesh = shaken_box(4, 0.2, 11);
  VolumeVcvOptions options;
  options.angles = VcvAngles::adjusted;
  options.length_power = 0.4;
  const VolumeVcvs vcvs(mesh.topology, mesh.coordinates, options);
  const auto classes = std::make_shared<const NodeClasses>(mesh.topology);
  const PointwiseForm<3> form(vcvs, classes, 1);
  std::vector<double> residual(form.unknowns());
  form.residual(mesh.coordinates, residual);
  const auto free = mesh.topology->interior_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const VolumeNodalView view =
        inspect_node(*mesh.topology, mesh.coordinates,
                     make_node_vcv(*mesh.topology, mesh.coordinates, free[i], options));
    std::vector<double> weights(view.neighbours.size());
    form.weights(mesh.coordinates, free[i], weights);
    for (std::size_t k = 0; k < weights.size(); ++k)
      CHECK(view.weights[k] == doctest::Approx(weights[k]).epsilon(1e-5));
    const Vec3 expected(residual.data() + 3 * i);
    CHECK((view.residual - expected).norm() < 1e-6 * (1 + expected.norm()));
    // The VCV is turned in the picture: so is the tensor.
    const Eigen::Matrix3d& turn = view.turned_by;
    const Eigen::Matrix3d tensor =
        turn * form.coefficients(mesh.coordinates, free[i]) * turn.transpose();
    CHECK((tensor - view.tensor).norm() < 1e-6);
    double sum = 0;
    for (const double angle : view.vcv.solid_angles) sum += angle;
    CHECK(sum == doctest::Approx(4 * pi));
  }
}

TEST_CASE(
    "over a linear image of the star the Jacobian is the inverse map, and the residual zero") {
  const Mesh mesh = shaken_box(3, 0.2, 12);
  const Index node = mesh.topology->interior_nodes().front();
  Eigen::Matrix3d map;
  map << 2, 0.3, 0, 0, 0.7, 0.1, 0.2, 0, 1.3;
  const VolumeNodalView view =
      inspect_node(*mesh.topology, mesh.coordinates, mapped_star(mesh, node, map));
  const Eigen::Matrix3d back = view.gradient * view.turned_by * map;
  CHECK((back - Eigen::Matrix3d::Identity()).norm() < 1e-12);
  CHECK(view.scaled_residual < 1e-12);
  CHECK(view.singular_values.prod() == doctest::Approx(1 / map.determinant()));
  CHECK(view.kappa == doctest::Approx(view.singular_values[0] / view.singular_values[2]));
  // u maps to the half axes: u diag(s)^2 u^T = G G^T.
  const Eigen::Matrix3d squares =
      view.u * view.singular_values.cwiseAbs2().asDiagonal() * view.u.transpose();
  CHECK((squares - view.gradient * view.gradient.transpose()).norm() < 1e-12);
}

TEST_CASE("a VCV that is a turned star lies over the star again") {
  const Mesh mesh = shaken_box(3, 0.2, 13);
  for (const Index node : mesh.topology->interior_nodes()) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(2.2, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    const VolumeNodalView view =
        inspect_node(*mesh.topology, mesh.coordinates, mapped_star(mesh, node, turn));
    for (std::size_t k = 0; k < view.neighbours.size(); ++k)
      CHECK((view.vcv.points[k] - view.physical.points[k]).norm() < 1e-12);
    for (std::size_t t = 0; t < view.targets.size(); ++t)
      CHECK(view.vcv.solid_angles[t] == doctest::Approx(view.physical.solid_angles[t]));
    CHECK(view.kappa == doctest::Approx(1));
  }
}

TEST_CASE("a fitted rotation never mirrors") {
  const std::vector<Vec3> from{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Vec3> to{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  const Eigen::Matrix3d r = fitted_rotation(from, to);
  CHECK(r.determinant() == doctest::Approx(1));
  CHECK((r * r.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-12);
}

TEST_CASE("why a node of a volume mesh has no VCV is said") {
  const Mesh mesh = make_mesh(cube(2, Volumes::tetrahedra));
  CHECK_THROWS_WITH_AS(require_inspectable(*mesh.topology, 0),
                       "node 0 lies on the boundary or on a marker: it has no VCV", UsageError);
  CHECK_THROWS_AS(require_inspectable(*mesh.topology, 1000), UsageError);
  CHECK_NOTHROW(require_inspectable(*mesh.topology, mesh.topology->interior_nodes().front()));
}
