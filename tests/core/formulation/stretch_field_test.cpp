#include "core/formulation/stretch_field.h"
#include "core/formulation/target_shapes.h"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/command/command.h"
#include "core/formulation/target_metric.h"
#include "core/formulation/variational_winslow.h"
#include "core/mesh/mesh.h"
#include "support/formulations.h"
#include "support/layered_meshes.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// The mesh drawn out along x.
Mesh drawn_out(MeshData data, double factor) {
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    data.coordinates.set_xy(i, Vec2(factor * p.x(), p.y()));
  }
  return make_mesh(data);
}

/// s of StretchField from singular values.
double stretch_by_svd(const Vec2& m1, const Vec2& m2, double angle) {
  Eigen::Matrix2d own, regular;
  own << m1, m2;
  regular << Vec2(1, 0), Vec2(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d s =
      Eigen::JacobiSVD<Eigen::Matrix2d>(own * regular.inverse()).singularValues();
  return 0.5 * std::log(s[0] / s[1]);
}

/// Interior nodes moved by up to `reach` of the shortest edge at each.
Mesh jittered(Mesh mesh, double reach, std::uint64_t seed) {
  const Coordinates given = mesh.coordinates;
  Random random(seed);
  for (const Index node : mesh.topology->interior_nodes()) {
    const Vec3 p = place_of(given, node);
    double shortest = std::numeric_limits<double>::infinity();
    for (const Index other : mesh.topology->neighbours(node))
      shortest = std::min(shortest, (place_of(given, other) - p).norm());
    mesh.coordinates.set_place(node, p + reach * shortest * random_vector(random));
  }
  return mesh;
}

double worst_of(const Mesh& mesh) {
  return check_validity(*mesh.topology, mesh.coordinates).min_sine;
}

CommandResult smoothed(const Mesh& mesh) {
  SmoothCommand command;
  command.smooth.threads = 1;
  return execute(command, make_state(mesh));
}

/// Layers around an ellipse that begin at 1e-4 of it.
std::vector<double> layer_distances() {
  std::vector<double> distance{0};
  for (int k = 0; k < 16; ++k) distance.push_back(distance.back() + 1e-4 * std::pow(1.5, k));
  return distance;
}

/// An interior node, and an element of which it is a corner that is moved so close to the opposite
/// edge that a sliver is left.
Index make_sliver(Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  const Index node = topology.interior_nodes()[topology.interior_nodes().size() / 2];
  const Index e = topology.star(node)[0];
  Vec2 edge = Vec2::Zero();
  for (const Index other : topology.element(e))
    if (other != node) edge += 0.5 * mesh.coordinates.xy(other);
  mesh.coordinates.set_xy(node, 0.02 * mesh.coordinates.xy(node) + 0.98 * edge);
  return e;
}

/// s of a tetrahedron.
double stretch_of(const Mesh& mesh, Index e) {
  const auto nodes = mesh.topology->element(e);
  const auto corner = corner_tetrahedra(ElementType::tetrahedron)[0];
  const auto place = [&](std::size_t k) { return mesh.coordinates.xyz(nodes[at(corner[k])]); };
  Edges3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = place(at(k + 1)) - place(0);
  return 0.5 * stretch_between(regular_metrics(ElementType::tetrahedron)[0], volume_metric(edges));
}

/// The median of s over the tetrahedra with a common node, by the definition. stretch: s of all.
double median_stretch(const Topology& topology, std::span<const double> stretch, Index e) {
  std::vector<Index> around;
  for (const Index node : topology.element(e))
    around.insert(around.end(), topology.star(node).begin(), topology.star(node).end());
  sort_unique(around);
  std::vector<double> found;
  for (const Index other : around) found.push_back(stretch[at(other)]);
  std::ranges::sort(found);
  return found[(found.size() - 1) / 2];
}

}  // namespace

TEST_CASE("the stretch between two triangles is that of the map between them") {
  Random random(7);
  for (int k = 0; k < 100; ++k) {
    const Vec2 m1(random.uniform(0.1, 2), random.uniform(-1, 1));
    const Vec2 m2 = Vec2(-m1.y(), m1.x()) * random.uniform(1e-5, 3) + m1 * random.uniform(-2, 2);
    const TargetMetric regular = TargetMetric::of_angle(pi / 3), own = TargetMetric::of(m1, m2);
    const double s = 0.5 * stretch_between(regular, own);
    CHECK(s == doctest::Approx(stretch_by_svd(m1, m2, pi / 3)).epsilon(1e-7));
    // Along the geodesic the stretch grows evenly, and the ends are what they should be.
    const double share = random.uniform(0, 1);
    const TargetMetric on_the_way = between(regular, own, share);
    CHECK(on_the_way.a11 * on_the_way.a22 - on_the_way.a12 * on_the_way.a12 ==
          doctest::Approx(1).epsilon(1e-6));
    CHECK(0.5 * stretch_between(regular, on_the_way) == doctest::Approx(share * s).epsilon(1e-5));
    CHECK(between(regular, own, 1).a11 == doctest::Approx(own.a11));
    CHECK(between(regular, own, 0).a11 == doctest::Approx(regular.a11));
  }
}

TEST_CASE("isotropic triangles become regular; those stretched alike keep their shapes") {
  const Mesh isotropic = drawn_out(square(10, Cells::triangles), 1);
  const StretchField regular = stretch_field(*isotropic.topology, isotropic.coordinates, 1);
  CHECK(regular.stretched == 0);
  CHECK(std::ranges::all_of(regular.share, [](double share) { return share == 0; }));

  const Mesh stretched = drawn_out(square(10, Cells::triangles), 20);
  const StretchField kept = stretch_field(*stretched.topology, stretched.coordinates, 1);
  CHECK(kept.stretched == 1);
  CHECK(std::ranges::all_of(kept.share, [](double share) { return share == 1; }));
  const VirtualControlVolumes vcv(stretched.topology);
  const VariationalWinslow energy(
      free_interior(stretched.topology),
      TargetShapes::build(vcv, TargetBlend::automatically(), &stretched.coordinates, 1), {}, 1);
  CHECK(energy.worst_distortion(stretched.coordinates) == doctest::Approx(1));
}

TEST_CASE("quadrilaterals of a regular grid keep their shapes, stretched or not") {
  for (const double factor : {1.0, 1.5, 1000.0}) {
    const Mesh mesh = drawn_out(square(10, Cells::quads), factor);
    const VirtualControlVolumes vcv(mesh.topology);
    const VariationalWinslow energy(
        free_interior(mesh.topology),
        TargetShapes::build(vcv, TargetBlend::automatically(), &mesh.coordinates, 1), {}, 1);
    CHECK(energy.worst_distortion(mesh.coordinates) == doctest::Approx(1));
    CHECK(energy.shapes().stretched == (factor > 2 ? 1 : 0));
  }
}

TEST_CASE("a sliver takes on the stretch of its neighbours") {
  for (const double factor : {1.0, 30.0}) {
    CAPTURE(factor);
    Mesh mesh = drawn_out(square(10, Cells::triangles), factor);
    const Topology& topology = *mesh.topology;
    const StretchField before = stretch_field(topology, mesh.coordinates, 1);
    const Index e = make_sliver(mesh);
    const auto nodes = topology.element(e);
    const Vec2 a = mesh.coordinates.xy(nodes[0]);
    const double s = stretch_by_svd(mesh.coordinates.xy(nodes[1]) - a,
                                    mesh.coordinates.xy(nodes[2]) - a, pi / 3);
    const StretchField field = stretch_field(topology, mesh.coordinates, 1);
    CHECK(s > before.longest[at(e)] + 0.3);  // it is one
    const double target = s * field.share[at(e)] * std::min(1.0, field.longest[at(e)] / s);
    CHECK(target <= before.longest[at(e)] + 0.05);
  }
}

TEST_CASE("around inverted elements, and in a tangled mesh, targets are regular") {
  Mesh mesh = drawn_out(square(20, Cells::triangles), 30);
  const Topology& topology = *mesh.topology;
  const Index node = topology.interior_nodes()[200];
  mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + Vec2(40, 0));
  const StretchField field = stretch_field(topology, mesh.coordinates, 1);
  for (const Index e : topology.star(node)) CHECK(field.share[at(e)] == 0);
  CHECK(field.stretched > 0.8);

  Random random(3);
  for (const Index free : topology.interior_nodes())
    mesh.coordinates.set_xy(free, Vec2(random.uniform(0, 30), random.uniform(0, 1)));
  const StretchField tangled = stretch_field(topology, mesh.coordinates, 1);
  CHECK(tangled.stretched == 0);
  CHECK(std::ranges::all_of(tangled.share, [](double share) { return share == 0; }));
}

TEST_CASE("the field does not depend on the number of threads") {
  const Mesh mesh = make_mesh(annulus(120, 60, 1.05, Cells::mixed));
  const StretchField one = stretch_field(*mesh.topology, mesh.coordinates, 1);
  const StretchField four = stretch_field(*mesh.topology, mesh.coordinates, 4);
  CHECK(one.share == four.share);
  CHECK(one.longest == four.longest);
  CHECK(one.weight == four.weight);
  CHECK(one.stiffness == four.stiffness);
}

TEST_CASE("elements that keep a stretch are as stiff as they are stretched, within bounds") {
  for (const auto& expected :
       {std::pair{1.0, 1.0}, {3.0, 1.0}, {20.0, 5.0}, {400.0, 100.0}, {1e4, 300.0}}) {
    const double aspect = expected.first, stiffness = expected.second;
    CAPTURE(aspect);
    const Mesh quads = drawn_out(square(6, Cells::quads), aspect);
    for (const double value : stretch_field(*quads.topology, quads.coordinates, 1).stiffness)
      CHECK(value == doctest::Approx(stiffness));
  }
}

TEST_CASE("layers at a wall keep their heights where the passage before it becomes narrow") {
  constexpr Index sectors = 60, rings = 16;
  constexpr double first = 1e-4, growth = 1.5;
  MeshData data = annulus(sectors, rings, 1.1, Cells::quads);
  double height = 0;  // of a ring over the wall
  for (Index i = 0; i <= rings; ++i) {
    for (Index j = 0; j < sectors; ++j) {
      const Vec2 p = data.coordinates.xy(i * sectors + j);
      data.coordinates.set_xy(i * sectors + j, (1 + height) * p.normalized());
    }
    height += first * std::pow(growth, i);
  }
  MoveCommand command;
  command.bodies[0].markers = {"inner"};
  command.bodies[0].motion.translate = {0.1, 0};  // the gap was 0.13
  command.smooth.threads = 1;
  const CommandResult moved = execute(command, make_state(make_mesh(data)));
  REQUIRE(moved.smooth.converged);
  CHECK(moved.smooth.fraction_reached == 1);
  CHECK(moved.smooth.inverted == 0);
  const Coordinates& x = moved.state.mesh.coordinates;
  double least = 1;  // first height over the one before
  for (Index j = 0; j < sectors; ++j)
    least = std::min(least, (x.xy(sectors + j) - x.xy(j)).norm() / first);
  CHECK(least > 0.98);  // 0.61 if all elements counted the same
}

TEST_CASE("jittered squares and cubes become squares and cubes") {
  for (const std::uint64_t seed : {1u, 2u}) {
    CAPTURE(seed);
    const Mesh squares = jittered(make_mesh(square(12, Cells::quads)), 0.3, seed);
    REQUIRE(worst_of(squares) < 0.8);
    CHECK(worst_of(smoothed(squares).state.mesh) > 0.98);
    const Mesh cubes = jittered(make_mesh(cube(6, Volumes::hexahedra)), 0.25, seed);
    REQUIRE(worst_of(cubes) < 0.75);
    CHECK(worst_of(smoothed(cubes).state.mesh) > 0.97);
  }
}

TEST_CASE("an O-grid with boundary layers stays as it is") {
  const Mesh mesh = make_mesh(o_grid(80, layer_distances(), Cut::none, 0.1));
  const CommandResult result = smoothed(mesh);
  REQUIRE(result.smooth.converged);
  CHECK(worst_of(result.state.mesh) >= worst_of(mesh) - 1e-9);
  const auto change =
      compare_first_heights(measure_walls(mesh).walls, measure_walls(result.state.mesh).walls);
  REQUIRE(change);
  CHECK(change->ratio.min > 0.999);
  CHECK(change->ratio.max < 1.001);
  CHECK(*result.smooth.stretched > 0.6);
}

TEST_CASE("a jittered O-grid loses its jitter and keeps its layers") {
  const Mesh regular = make_mesh(o_grid(80, layer_distances(), Cut::none, 0.5));
  const Mesh mesh = jittered(regular, 0.3, 4);
  const CommandResult result = smoothed(mesh);
  REQUIRE(result.smooth.converged);
  CHECK(worst_of(mesh) < 0.9);
  CHECK(worst_of(result.state.mesh) > worst_of(mesh) + 0.05);
  const auto off = [&](const Mesh& other) {
    const auto change =
        compare_first_heights(measure_walls(regular).walls, measure_walls(other).walls);
    REQUIRE(change);
    CHECK(change->ratio.median == doctest::Approx(1).epsilon(0.05));
    return change->ratio.high - change->ratio.low;
  };
  const double before = off(mesh), after = off(result.state.mesh);
  CHECK(after < 0.65 * before);
}

TEST_CASE("pyramids keep their shapes beside tetrahedra that do not") {
  const Mesh mesh = jittered(make_mesh(cube(5, Volumes::mixed)), 0.2, 5);
  const StretchField field = stretch_field(*mesh.topology, mesh.coordinates, 1);
  const Mesh after = smoothed(mesh).state.mesh;
  const auto before_values = element_values(mesh, Metric::normalized_jacobian);
  const auto after_values = element_values(after, Metric::normalized_jacobian);
  double before_sum = 0, after_sum = 0;
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    if (mesh.topology->element_type(e) == ElementType::hexahedron)
      CHECK(field.stiffness[at(e)] >= 8.5);
    if (mesh.topology->element_type(e) != ElementType::pyramid) continue;
    CHECK(field.stiffness[at(e)] >= 30);
    before_sum += before_values[at(e)];
    after_sum += after_values[at(e)];
  }
  REQUIRE(before_sum > 0);
  CHECK(after_sum > 0.97 * before_sum);
}

TEST_CASE("in space the permitted stretch is that of the median around, to the bit") {
  // Cubes cut around their diagonals have nearly regular tetrahedra if the diagonals are halved.
  MeshData data = cube(12, Volumes::tetrahedra);
  const Vec3 diagonal = Vec3(1, 1, 1) / std::sqrt(3.0);
  for (Index node = 0; node < data.node_count(); ++node) {
    Vec3 p = data.coordinates.xyz(node);
    if (p.z() > 0.5) p.z() = 0.5 + (p.z() - 0.5) / 6;
    data.coordinates.set_xyz(node, p - 0.5 * p.dot(diagonal) * diagonal);
  }
  const Mesh mesh = jittered(make_mesh(data), 0.1, 5);
  const StretchField field = stretch_field(*mesh.topology, mesh.coordinates, 1);
  const StretchField four = stretch_field(*mesh.topology, mesh.coordinates, 4);
  CHECK(field.share == four.share);
  CHECK(field.longest == four.longest);
  CHECK(field.stiffness == four.stiffness);
  CHECK(field.stretched == four.stretched);
  Index kept = 0, isotropic = 0;
  std::vector<double> stretch;
  for (Index e = 0; e < mesh.topology->element_count(); ++e) stretch.push_back(stretch_of(mesh, e));
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const double median = median_stretch(*mesh.topology, stretch, e);
    if (field.share[at(e)] > 0) {
      CHECK(field.longest[at(e)] == median + 0.35);
      ++kept;
    } else {
      CHECK(median <= 0.45);
      CHECK(field.longest[at(e)] == 0);
      ++isotropic;
    }
  }
  CHECK(kept > 100);
  CHECK(isotropic > 100);
  // Next to an inverted element no shape counts, in the quick way of counting, too.
  Mesh spoilt = mesh;
  const Index node = mesh.topology->interior_nodes().back();
  const Index other = mesh.topology->neighbours(node).front();
  spoilt.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + 1.5 * (mesh.coordinates.xyz(other) -
                                                                       mesh.coordinates.xyz(node)));
  REQUIRE(check_validity(*spoilt.topology, spoilt.coordinates, 1).inverted > 0);
  const StretchField lost = stretch_field(*spoilt.topology, spoilt.coordinates, 1);
  for (const Index e : spoilt.topology->star(node)) CHECK(lost.share[at(e)] == 0);
  CHECK(lost.stretched > 0);
}
