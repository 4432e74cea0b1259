#include "core/inspect/nodal_view.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/formulation/pointwise_winslow.h"
#include "core/inspect/element_field.h"
#include "core/inspect/node_roles.h"
#include "core/strategy/mesh_state.h"
#include "core/vcv/sphere/volume_vcvs.h"
#include "support/formulations.h"
#include "support/samples.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"
#include "support/vcv.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A regular star, its nodes moved by x -> A x + b: the VCV's own shape under an affine map.
Mesh affine_star(Index n, const Eigen::Matrix2d& a, const Vec2& b) {
  Mesh mesh = make_mesh(regular_star(n));
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    mesh.coordinates.set_xy(i, a * mesh.coordinates.xy(i) + b);
  }
  return mesh;
}

}  // namespace

TEST_CASE("an affine map of the VCV: its matrix is the nodal Jacobian, its residual zero") {
  Eigen::Matrix2d a;
  a << 2, 1, -0.5, 3;
  for (Index n = 3; n <= 9; ++n) {
    CAPTURE(n);
    const Mesh mesh = affine_star(n, a, Vec2(10, -4));
    const NodalView view = inspect_node(VirtualControlVolumes(mesh.topology), mesh.coordinates, 0);
    REQUIRE(view.neighbours.size() == static_cast<std::size_t>(n));
    // The VCV's edge 0 lies on the x axis, wherever that neighbour was in the star.
    Eigen::Matrix2d jacobian;
    jacobian << view.gradient.rx, view.gradient.ry;
    const Eigen::Vector2d singular = Eigen::JacobiSVD<Eigen::Matrix2d>(a).singularValues();
    CHECK(jacobian.determinant() == doctest::Approx(a.determinant()));
    CHECK(view.singular_values[0] == doctest::Approx(singular[0]));
    CHECK(view.singular_values[1] == doctest::Approx(singular[1]));
    CHECK(view.kappa == doctest::Approx(singular[0] / singular[1]));
    CHECK(view.scaled_residual < 1e-14);
    CHECK((view.position - Vec2(10, -4)).norm() < 1e-14);
    CHECK_FALSE(view.edited);
    double area = 0, turn = 0;
    for (std::size_t k = 0; k < view.neighbours.size(); ++k) {
      CHECK((jacobian * view.vcv.points[k] - view.physical.points[k]).norm() < 1e-12);
      CHECK(view.physical.areas[k] == doctest::Approx(a.determinant() * view.vcv.areas[k]));
      area += view.vcv.areas[k];
      turn += view.physical.angles[k];
    }
    CHECK(area == doctest::Approx(0.5 * n * std::sin(2 * pi / n)));
    CHECK(turn == doctest::Approx(2 * pi));
  }
}

TEST_CASE("a conformal map: equal weights, kappa 1, and the VCV turned over the star fits it") {
  const double angle = 0.7;
  Eigen::Matrix2d a;
  a << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const Mesh mesh = affine_star(7, 3 * a, Vec2(1, 2));
  const NodalView view = inspect_node(VirtualControlVolumes(mesh.topology), mesh.coordinates, 0);
  CHECK(view.kappa == doctest::Approx(1));
  CHECK(view.coefficients.alpha == doctest::Approx(1));
  CHECK(std::abs(view.coefficients.beta) < 1e-14);
  for (const double w : view.weights) CHECK(w == doctest::Approx(2 * std::tan(pi / 7)));
  CHECK(view.smallest_weight == doctest::Approx(1));
  const double turn = fitted_turn(view.vcv, view.physical);
  for (std::size_t k = 0; k < 7; ++k) {
    const Vec2& v = view.vcv.points[k];
    const Vec2 turned(std::cos(turn) * v.x() - std::sin(turn) * v.y(),
                      std::sin(turn) * v.x() + std::cos(turn) * v.y());
    CHECK((3 * turned - view.physical.points[k]).norm() < 1e-12);
  }
}

TEST_CASE("a node's view agrees with an integration triangle by triangle") {
  constexpr std::uint64_t seed = 11;
  CAPTURE(seed);
  for (const Cells cells : all_cells) {
    CAPTURE(name_of(cells));
    const Sample sample = make_sample(seed, cells, false);
    const PointwiseWinslow operator_ = pointwise(sample.vcv);
    for (const Index node : sample.mesh.topology->interior_nodes()) {
      const NodalView view = inspect_node(sample.vcv, sample.mesh.coordinates, node);
      if (view.neighbours.size() < 3) continue;
      std::vector<Vec2> around;
      for (const Index k : view.neighbours) around.push_back(sample.mesh.coordinates.xy(k));
      const BruteForce brute =
          integrate(view.vcv.points, view.position, around, Eigen::Matrix2d::Identity());
      CHECK((view.gradient.rx - brute.gradient.col(0)).norm() < 1e-12);
      CHECK((view.gradient.ry - brute.gradient.col(1)).norm() < 1e-12);
      const Eigen::Matrix2d k = winslow_matrix(brute.gradient);
      const Vec2 flux =
          integrate(view.vcv.points, view.position, around, 2 * k / k.trace()).residual;
      CHECK((view.residual - flux).norm() < 1e-12);
      CHECK(view.edited == sample.vcv.edited(node));
      std::vector<double> weights(view.weights.size());
      operator_.weights(sample.mesh.coordinates, node, weights);
      CHECK(view.weights == weights);
    }
  }
}

TEST_CASE("what has no VCV says why") {
  MeshData data = regular_star(5);
  data.coordinates.push_xy({9, 9});
  const Mesh mesh = make_mesh(data);
  const VirtualControlVolumes vcv(mesh.topology);
  const auto message = [&](Index node) {
    try {
      inspect_node(vcv, mesh.coordinates, node);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(message(0).empty());
  CHECK(message(3) == "node 3 lies on the boundary or on a marker: it has no VCV");
  CHECK(message(6) == "node 6 belongs to no element: it has no VCV");
  CHECK(message(7) == "the mesh has no node 7: its nodes count from 0 to 6");
  CHECK(message(-1) == "the mesh has no node -1: its nodes count from 0 to 6");
}

TEST_CASE("fields: the value of each node is that of its view, an element has its worst node's") {
  constexpr std::uint64_t seed = 5;
  CAPTURE(seed);
  const Sample sample = make_sample(seed, Cells::mixed, false);
  const Topology& topology = *sample.mesh.topology;
  const Coordinates& x = sample.mesh.coordinates;
  for (const NodalField field :
       {NodalField::kappa, NodalField::smallest_weight, NodalField::residual}) {
    const auto at_nodes = node_values(sample.vcv, x, field, 1);
    CHECK(at_nodes.size() == static_cast<std::size_t>(topology.node_count()));
    for (Index node = 0; node < topology.node_count(); ++node) {
      if (topology.on_boundary(node)) {
        CHECK(std::isnan(at_nodes[at(node)]));
        continue;
      }
      const NodalView view = inspect_node(sample.vcv, x, node);
      const double expected = field == NodalField::kappa      ? view.kappa
                              : field == NodalField::residual ? view.scaled_residual
                                                              : view.smallest_weight;
      CHECK(at_nodes[at(node)] == doctest::Approx(expected));
    }
    const auto at_elements = element_values(sample.vcv, x, field, 1);
    for (Index e = 0; e < topology.element_count(); ++e) {
      bool any = false, found = false;
      for (const Index node : topology.element(e)) {
        const double value = at_nodes[at(node)];
        if (std::isnan(value)) continue;
        any = true;
        found = found || value == at_elements[at(e)];
        CHECK((field == NodalField::smallest_weight ? value >= at_elements[at(e)]
                                                    : value <= at_elements[at(e)]));
      }
      CHECK(found == any);
      CHECK(std::isnan(at_elements[at(e)]) != any);
    }
  }
}

TEST_CASE("fields of walls on an annulus are its radii's") {
  constexpr Index sectors = 24, rings = 5;
  constexpr double growth = 1.3;
  const Mesh mesh = make_mesh(annulus(sectors, rings, growth, Cells::quads));
  const VirtualControlVolumes vcv(mesh.topology);
  const auto values = [&](WallField field) { return element_values(vcv, mesh.coordinates, field); };
  const auto height = values(WallField::first_height), tilt = values(WallField::first_edge_tilt),
             ratio = values(WallField::size_ratio);
  for (std::size_t e = 0; e < height.size(); ++e) {
    CHECK(ratio[e] == doctest::Approx(growth));
    const bool inner = e < static_cast<std::size_t>(sectors);  // the first ring comes first
    REQUIRE(std::isnan(height[e]) != inner);
    REQUIRE(std::isnan(tilt[e]) != inner);
    if (!inner) continue;
    CHECK(height[e] == doctest::Approx(growth - 1));
    CHECK(std::abs(tilt[e]) < 1e-5);
  }
}

TEST_CASE("fields do not depend on the number of threads, and have names to be found by") {
  const Mesh mesh = make_mesh(square(90, Cells::triangles));
  const VirtualControlVolumes vcv(mesh.topology);
  Mesh moved = mesh;
  constexpr std::uint64_t seed = 3;
  Random random(seed);
  perturb(moved, random);
  for (const ElementField& field : all_element_fields()) {
    CHECK(parse_field(field_info(field).name) == field);
    const auto one = element_values(vcv, moved.coordinates, field, 1);
    const auto four = element_values(vcv, moved.coordinates, field, 4);
    bool same = one.size() == four.size();
    for (std::size_t e = 0; same && e < one.size(); ++e) {
      same = one[e] == four[e] || (std::isnan(one[e]) && std::isnan(four[e]));
    }
    CHECK(same);
  }
  CHECK_THROWS_WITH_AS(parse_field("beauty"),
                       "found \"beauty\", expected one of normalized_jacobian, aspect_ratio, "
                       "condition_number, smallest_angle, largest_angle, skewness, area, kappa, "
                       "smallest_weight, residual, first_height, first_height_ratio, "
                       "first_edge_tilt, growth, size_ratio, layer, spacing_error",
                       UsageError);
}

namespace winslow::test {

TEST_CASE("a star of a plane surface, laid flat, is that of the plane") {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(2, 1, -2).normalized()).toRotationMatrix();
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    Random random(3);
    const MeshData data = square(6, cells);
    Mesh plane = make_mesh(data);
    perturb(plane, random, 0.3);
    Mesh mesh = make_mesh(lifted(data, [](const Vec2& p) { return Vec3(p.x(), p.y(), 0); }));
    for (Index i = 0; i < plane.coordinates.size(); ++i) {
      const Vec2 p = plane.coordinates.xy(i);
      mesh.coordinates.set_xyz(i, turn * Vec3(p.x(), p.y(), 0) + Vec3(3, 4, 5));
    }
    const VirtualControlVolumes flat(plane.topology), lying(mesh.topology);
    for (const Index node : plane.topology->interior_nodes()) {
      const NodalView a = inspect_node(flat, plane.coordinates, node);
      const NodalView b = inspect_node(lying, mesh.coordinates, node);
      REQUIRE(a.neighbours == b.neighbours);
      CHECK(b.kappa == doctest::Approx(a.kappa));
      CHECK(b.smallest_weight == doctest::Approx(a.smallest_weight));
      CHECK(b.scaled_residual == doctest::Approx(a.scaled_residual));
      for (std::size_t k = 0; k < a.neighbours.size(); ++k) {
        CHECK(b.physical.angles[k] == doctest::Approx(a.physical.angles[k]));
        CHECK(b.physical.lengths[k] == doctest::Approx(a.physical.lengths[k]));
        CHECK(b.weights[k] == doctest::Approx(a.weights[k]));
      }
    }
  }
}

TEST_CASE("the angles of a tip are scaled to 360 degrees, its edges keep their lengths") {
  // Node 4 of an octahedron has four angles of 60 degrees.
  const Mesh mesh = make_mesh(octasphere(1));
  const VirtualControlVolumes vcv(mesh.topology);
  const NodalView view = inspect_node(vcv, mesh.coordinates, 4);
  REQUIRE(view.physical.angles.size() == 4);
  for (const double angle : view.physical.angles) CHECK(degrees(angle) == doctest::Approx(90));
  for (const double length : view.physical.lengths)
    CHECK(length == doctest::Approx(std::sqrt(2.0)));
  CHECK(view.kappa == doctest::Approx(1));
  CHECK(view.scaled_residual == doctest::Approx(0).epsilon(1e-12));
}

TEST_CASE("roles of a surface: inside of faces nodes slide, edges stay or slide, corners stay") {
  // The boundary of a cube of 4 by 4 by 4 cells.
  const Mesh box = make_mesh(skin(cube(4, Volumes::hexahedra)));
  const MeshState state = make_state(box);
  SlideOptions slide;
  const auto count = [](const NodeRoles& roles, NodeRole role) {
    CHECK(roles.counts[static_cast<std::size_t>(role)] == std::ranges::count(roles.roles, role));
    return roles.counts[static_cast<std::size_t>(role)];
  };
  const NodeRoles still = node_roles(state, slide, {});
  CHECK(still.fault.empty());
  CHECK(count(still, NodeRole::on_surface) == 6 * 9);
  CHECK(count(still, NodeRole::corner) == 8 + 12 * 3);
  CHECK(still.features.size() == 12 * 4);
  CHECK(std::ranges::count(still.found, "plane") == 6);
  slide.features = true;
  const NodeRoles roles = node_roles(state, slide, {});
  CHECK(count(roles, NodeRole::on_curve) == 12 * 3);
  CHECK(count(roles, NodeRole::corner) == 8);
  // At 100 degrees nothing is sharp.
  slide.feature_angle = 100;
  const NodeRoles smooth = node_roles(state, slide, {});
  CHECK(smooth.features.empty());
  CHECK(smooth.fault.empty());
}

}  // namespace winslow::test

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
