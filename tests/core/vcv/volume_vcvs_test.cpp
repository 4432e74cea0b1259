#include "core/vcv/sphere/volume_vcvs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/command/command.h"
#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/vcv/sphere/sphere_link.h"
#include "support/dual_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::vector<Vec3> directions_of(const VolumeVcvs& vcvs, Index node) {
  std::vector<Vec3> directions;
  const auto count = static_cast<Index>(vcvs.topology().neighbours(node).size());
  for (Index k = 0; k < count; ++k) directions.push_back(vcvs.direction(node, k));
  return directions;
}

VolumeVcvs of_mesh(const Mesh& mesh, VcvAngles angles, double regularisation = 0.3) {
  VolumeVcvOptions options;
  options.angles = angles;
  options.physical_regularisation = regularisation;
  return {mesh.topology, mesh.coordinates, options};
}

/// The mean distance from pi of the solid angles in a mesh of nodes with four edges.
double mean_error(const Topology& topology, const Coordinates& x) {
  double sum = 0;
  std::vector<Vec3> physical;
  for (const Index node : topology.interior_nodes()) {
    physical_directions(SpacePoints(x), node, topology.neighbours(node), physical);
    const SphereLink link(topology, node);
    for (const auto& [a, b, c] : link.triangles())
      sum += std::abs(solid_angle(physical[at(a)], physical[at(b)], physical[at(c)]) - pi);
  }
  return sum / (4 * static_cast<double>(topology.interior_nodes().size()));
}

bool same_directions(const VolumeVcvs& a, const VolumeVcvs& b) {
  const auto interior = a.topology().interior_nodes();
  return std::all_of(interior.begin(), interior.end(),
                     [&](Index node) { return directions_of(a, node) == directions_of(b, node); });
}

}  // namespace

TEST_CASE("VCVs of any volume mesh have equal solid angles and unit edges") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(5, volumes));
    const VolumeVcvs vcvs(mesh.topology);
    const VolumeVcvStatistics statistics = measure_vcvs(vcvs);
    CHECK(statistics.stars == static_cast<Index>(mesh.topology->interior_nodes().size()));
    CHECK(statistics.off == 0);
    CHECK(statistics.max_error <= 1e-3);
    CHECK(statistics.mean_error <= statistics.max_error);
    CHECK(statistics.min_angle > 0);
    CHECK(statistics.min_cost >= 0);
    CHECK(statistics.max_cost < 1);
    for (const Index node : mesh.topology->interior_nodes()) {
      std::vector<Vec3> points;
      vcvs.points(node, points);
      CHECK(covers_sphere(SphereLink(*mesh.topology, node), points));
      for (const Vec3& p : points) CHECK(p.norm() == doctest::Approx(1));
    }
  }
}

TEST_CASE("the VCV of a node among cubes is the regular octahedron") {
  const Mesh mesh = make_mesh(cube(2, Volumes::hexahedra));
  const VolumeVcvs vcvs(mesh.topology);
  REQUIRE(mesh.topology->interior_nodes().size() == 1);
  const auto d = directions_of(vcvs, mesh.topology->interior_nodes().front());
  REQUIRE(d.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double cosine = d[i].dot(d[k]);
      CHECK(std::min(std::abs(cosine), std::abs(cosine + 1)) < 1e-3);
    }
  }
}

TEST_CASE("the VCV of a node of a dual of tetrahedra has four directions, pi each") {
  // Tetrahedra of a body-centred lattice, whose dual has truncated octahedra.
  Mesh tetrahedra = make_mesh(cube(6, Volumes::tetrahedra));
  Eigen::Matrix3d lattice;
  lattice << 1, 1, -1, 1, -1, 1, -1, 1, 1;
  for (Index i = 0; i < tetrahedra.coordinates.size(); ++i)
    tetrahedra.coordinates.set_xyz(i, lattice * tetrahedra.coordinates.xyz(i));
  const Mesh mesh = make_mesh(dual_of_interior(tetrahedra));
  REQUIRE(mesh.topology->has_polyhedra());
  const auto interior = mesh.topology->interior_nodes();
  REQUIRE(interior.size() > 100);
  const VolumeVcvs vcvs(mesh.topology);
  for (const Index node : interior) {
    const auto d = directions_of(vcvs, node);
    REQUIRE(d.size() == 4);
    const SphereLink link(*mesh.topology, node);
    REQUIRE(link.triangles().size() == 4);
    double sum = 0;
    for (const auto& [a, b, c] : link.triangles()) {
      const double angle = solid_angle(d[at(a)], d[at(b)], d[at(c)]);
      CHECK(angle == doctest::Approx(pi).epsilon(1e-6));
      sum += angle;
    }
    CHECK(sum == doctest::Approx(4 * pi));
    // Then they are those of the regular tetrahedron, 109.47 degrees apart.
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < i; ++k) CHECK(d[i].dot(d[k]) == doctest::Approx(-1.0 / 3));
  }
  // So are the angles in the mesh.
  CHECK(mean_error(*mesh.topology, mesh.coordinates) < 1e-12);
}

TEST_CASE("smoothing towards the VCVs of a dual mesh brings its solid angles nearer to pi") {
  const Mesh mesh = make_mesh(dual_of_interior(shaken_box(7, 0.3, 7)));
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend{.vcv = 1};
  const CommandResult result = execute(smooth, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  const Coordinates& x = result.state.mesh.coordinates;
  CHECK(largest_difference(x, mesh.coordinates) > 0.01);
  CHECK(mean_error(*mesh.topology, x) < mean_error(*mesh.topology, mesh.coordinates));
  // Equal angles are the default of meshes with polyhedra.
  smooth.smooth.vcv = VcvKind::equal;
  CHECK(execute(smooth, make_state(mesh)).state.mesh.coordinates == x);
}

TEST_CASE("existing angles are those of the mesh, as far as regularisation lets them") {
  const Mesh mesh = shaken_box(5, 0.25, 3);
  const VolumeVcvs exact = of_mesh(mesh, VcvAngles::existing, 0);
  CHECK(measure_vcvs(exact).off == 0);
  const SpacePoints x(mesh.coordinates);
  std::vector<Vec3> physical;
  for (const Index node : mesh.topology->interior_nodes()) {
    const auto neighbours = mesh.topology->neighbours(node);
    physical_directions(x, node, neighbours, physical);
    const SphereLink link(*mesh.topology, node);
    REQUIRE(covers_sphere(link, physical));
    const auto own = directions_of(exact, node);
    for (const auto& [a, b, c] : link.triangles()) {
      CHECK(solid_angle(own[at(a)], own[at(b)], own[at(c)]) ==
            doctest::Approx(solid_angle(physical[at(a)], physical[at(b)], physical[at(c)]))
                .epsilon(2e-3));
    }
  }
  const VolumeVcvStatistics shaped = measure_vcvs(of_mesh(mesh, VcvAngles::existing));
  CHECK(shaped.min_angle > 0);
  CHECK(shaped.limited_by_shape > 0);
  CHECK(shaped.limited_by_shape + shaped.out_of_steps == shaped.off);
  const VolumeVcvStatistics equal = measure_vcvs(of_mesh(mesh, VcvAngles::equal));
  CHECK(shaped.max_angle > equal.max_angle);
}

TEST_CASE("angles of a tangled mesh are made into targets that a VCV can have") {
  const Mesh mesh = shaken_box(5, 1.2, 4);
  for (const VcvAngles angles : {VcvAngles::existing, VcvAngles::adjusted}) {
    const VolumeVcvs vcvs = of_mesh(mesh, angles);
    CHECK(measure_vcvs(vcvs).min_angle > 0);
    std::vector<double> targets;
    const auto interior = mesh.topology->interior_nodes();
    for (std::size_t i = 0; i < interior.size(); ++i) {
      const SphereLink link(*mesh.topology, interior[i]);
      vcvs.targets(i, link, targets);
      double sum = 0;
      for (const double target : targets) sum += target;
      CHECK(sum == doctest::Approx(4 * pi).epsilon(1e-6));
      CHECK(*std::min_element(targets.begin(), targets.end()) > 0);
    }
  }
}

TEST_CASE("adjusted angles follow the mesh: only stars that changed are solved again") {
  Mesh mesh = shaken_box(6, 0.2, 5);
  VolumeVcvs vcvs = of_mesh(mesh, VcvAngles::adjusted);
  CHECK(vcvs.adjust(mesh.coordinates) == 0);
  const VolumeVcvs before = vcvs;
  const Index node = mesh.topology->interior_nodes()[60];
  mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + Vec3(0.02, 0.01, 0));
  // Its own angles change, and those of its neighbours that are free.
  Index concerned = 1;
  for (const Index k : mesh.topology->neighbours(node)) {
    concerned += mesh.topology->on_boundary(k) ? 0 : 1;
  }
  CHECK(vcvs.adjust(mesh.coordinates) == concerned);
  CHECK(measure_vcvs(vcvs).min_angle > 0);
  for (const Index other : mesh.topology->interior_nodes()) {
    const auto around = mesh.topology->neighbours(node);
    const bool near =
        other == node || std::find(around.begin(), around.end(), other) != around.end();
    if (!near) CHECK(directions_of(vcvs, other) == directions_of(before, other));
    if (other == node) CHECK(directions_of(vcvs, other) != directions_of(before, other));
  }
  VolumeVcvs equal(mesh.topology);
  CHECK_THROWS_AS(equal.adjust(mesh.coordinates), UsageError);
}

TEST_CASE("VCVs have the same bits at any number of threads") {
  const Mesh mesh = shaken_box(7, 0.3, 6);
  for (const VcvAngles angles : {VcvAngles::equal, VcvAngles::existing, VcvAngles::adjusted}) {
    for (const VcvConstruction construction :
         {VcvConstruction::fit, VcvConstruction::perturbation}) {
      VolumeVcvOptions options;
      options.angles = angles;
      options.construction = construction;
      options.threads = 1;
      const VolumeVcvs one(mesh.topology, mesh.coordinates, options);
      options.threads = 4;
      const VolumeVcvs four(mesh.topology, mesh.coordinates, options);
      CHECK(same_directions(one, four));
      CHECK(measure_vcvs(one, 1).mean_error == measure_vcvs(four, 4).mean_error);
      if (construction == VcvConstruction::fit || angles != VcvAngles::equal) continue;
      CHECK(measure_vcvs(one).mean_error > measure_vcvs(of_mesh(mesh, angles)).mean_error);
    }
  }
}

TEST_CASE("directions and lengths of a node are set, and reset") {
  const Mesh mesh = shaken_box(3, 0.1, 7);
  VolumeVcvs vcvs(mesh.topology);
  const Index node = mesh.topology->interior_nodes().front();
  const auto computed = directions_of(vcvs, node);
  std::vector<Vec3> directions;
  physical_directions(SpacePoints(mesh.coordinates), node, mesh.topology->neighbours(node),
                      directions);
  std::vector<double> lengths(directions.size(), 1.0);
  lengths[2] = 3;
  vcvs.set(node, directions, lengths);
  CHECK(vcvs.edited(node));
  CHECK(vcvs.length(node, 2) == 3);
  std::vector<Vec3> points;
  vcvs.points(node, points);
  CHECK((points[2] - 3 * directions[2]).norm() < 1e-14);
  CHECK(measure_vcvs(vcvs).stars == static_cast<Index>(mesh.topology->interior_nodes().size()) - 1);

  lengths[1] = 0;
  CHECK_THROWS_AS(vcvs.set(node, directions, lengths), UsageError);
  lengths[1] = 1e13;
  CHECK_THROWS_AS(vcvs.set(node, directions, lengths), UsageError);
  lengths[1] = 1;
  std::swap(directions[0], directions[1]);
  CHECK_THROWS_AS(vcvs.set(node, directions, lengths), UsageError);
  directions.pop_back();
  CHECK_THROWS_AS(vcvs.set(node, directions, lengths), UsageError);
  CHECK_THROWS_AS(vcvs.reset(0), UsageError);
  vcvs.reset(node);
  CHECK_FALSE(vcvs.edited(node));
  CHECK(directions_of(vcvs, node) == computed);
}

TEST_CASE("VCVs of solid angles are for volume meshes, those of a mesh need its coordinates") {
  const Mesh plane = make_mesh(square(3, Cells::triangles));
  CHECK_THROWS_AS(VolumeVcvs{plane.topology}, UsageError);
  VolumeVcvOptions options;
  options.angles = VcvAngles::existing;
  const Mesh mesh = make_mesh(cube(2, Volumes::tetrahedra));
  CHECK_THROWS_AS(VolumeVcvs(mesh.topology, options), UsageError);
}

TEST_CASE("edges of VCVs have powers of the lengths of the mesh") {
  const Mesh mesh = shaken_box(4, 0.3, 6);
  for (const VcvAngles angles : {VcvAngles::equal, VcvAngles::adjusted}) {
    for (const double power : {0.0, 0.5, 1.0}) {
      CAPTURE(power);
      const VolumeVcvs vcvs(mesh.topology, mesh.coordinates,
                            {.angles = angles, .length_power = power, .threads = 1});
      const VolumeVcvs unit(mesh.topology, mesh.coordinates, {.angles = angles, .threads = 2});
      for (const Index node : mesh.topology->interior_nodes()) {
        const auto neighbours = mesh.topology->neighbours(node);
        double sum = 0;
        for (const Index k : neighbours)
          sum += (mesh.coordinates.xyz(k) - mesh.coordinates.xyz(node)).norm();
        for (std::size_t k = 0; k < neighbours.size(); ++k) {
          const double length =
              (mesh.coordinates.xyz(neighbours[k]) - mesh.coordinates.xyz(node)).norm();
          const double share = length / sum * static_cast<double>(neighbours.size());
          const auto place = static_cast<Index>(k);
          CHECK(vcvs.length(node, place) == doctest::Approx(std::pow(share, power)).epsilon(1e-6));
          CHECK((vcvs.point(node, place).normalized() - unit.direction(node, place)).norm() <
                1e-12);
        }
      }
    }
  }
  CHECK_THROWS_AS(VolumeVcvs(mesh.topology, {.length_power = 0.5}), UsageError);
}

TEST_CASE("lengths stay those of the mesh as given when angles are adjusted") {
  const Mesh mesh = shaken_box(4, 0.3, 6);
  VolumeVcvs vcvs(mesh.topology, mesh.coordinates,
                  {.angles = VcvAngles::adjusted, .length_power = 1});
  const Index node = mesh.topology->interior_nodes().front();
  const double before = vcvs.length(node, 0);
  CHECK(vcvs.adjust(shaken_box(4, 0.3, 7).coordinates) > 0);
  CHECK(vcvs.length(node, 0) == before);
}
