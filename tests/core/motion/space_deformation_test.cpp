#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Names = std::vector<std::string>;

/// The cavity is [1/3, 2/3] in x, y and z.
Mesh cavity_mesh(Volumes volumes = Volumes::tetrahedra) {
  return make_mesh(cube_with_cavity(6, volumes));
}

Coordinates moved(const Mesh& mesh, const Names& names, const auto& shape, double fraction) {
  Coordinates x = mesh.coordinates;
  make_motion(*mesh.topology, x, names, shape)->apply(mesh.coordinates, fraction, x);
  return x;
}

Vec3 way(const Mesh& mesh, const Coordinates& x, Index node) {
  return x.xyz(node) - mesh.coordinates.xyz(node);
}

std::string refusal(const Mesh& mesh, const auto& shape) {
  try {
    moved(mesh, {mesh.topology->markers()[0].name}, shape, 1);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a sine in space displaces by its formula, along the way that is asked for") {
  const Mesh mesh = cavity_mesh();
  struct Case {
    SineDeformation sine;
    Vec3 direction, along;  // of length 1
  };
  SineDeformation plane{0.03, 1.5, {0, 4}};  // as in the plane: along x
  SineDeformation sideways{0.03, 1, {1, 0}};
  SineDeformation up{0.02, 1, {0, 0, -2}};
  up.along = Vec3(0, 3, 0);
  SineDeformation slanted{-0.02, 0.75, {1, 1, 1}};
  slanted.along = Vec3(1, -1, 2);
  const std::array<Case, 4> cases{
      Case{plane, Vec3(0, 1, 0), Vec3(1, 0, 0)}, Case{sideways, Vec3(1, 0, 0), Vec3(0, -1, 0)},
      Case{up, Vec3(0, 0, -1), Vec3(0, 1, 0)},
      Case{slanted, Vec3(1, 1, 1).normalized(), Vec3(1, -1, 2).normalized()}};
  const Names body{"cavity"};
  for (const auto& [sine, direction, along] : cases) {
    const auto nodes = mesh.topology->markers().nodes_of(body);
    double low = 1e9, high = -1e9;
    for (const Index node : nodes) {
      low = std::min(low, along.dot(mesh.coordinates.xyz(node)));
      high = std::max(high, along.dot(mesh.coordinates.xyz(node)));
    }
    for (const double fraction : {0.3, 1.0}) {
      const Coordinates x = moved(mesh, body, sine, fraction);
      for (const Index node : nodes) {
        const double s = (along.dot(mesh.coordinates.xyz(node)) - low) / (high - low);
        const double height = fraction * sine.amplitude * std::sin(2 * pi * sine.waves * s);
        CHECK((way(mesh, x, node) - height * direction).norm() < 1e-14);
      }
    }
  }
}

TEST_CASE("a sine in space needs a way to run along, and a plane one has none") {
  const Mesh space = cavity_mesh(), plane = make_mesh(square(3, Cells::quads));
  SineDeformation up{0.1, 1, {0, 0, 1}};
  CHECK(refusal(space, up).find("needs a way along which it runs") != std::string::npos);
  up.along = Vec3(0, 0, 0);
  CHECK(refusal(space, up) == "the way along which the sine runs is zero");
  up.along = Vec3(0, std::numeric_limits<double>::quiet_NaN(), 1);
  CHECK(refusal(space, up).find("not a finite number") != std::string::npos);
  up.direction = Vec3(0, 0, 0);
  CHECK(refusal(space, up) == "the direction of the sine is zero");
  SineDeformation along{0.1, 1, {0, 1}};
  along.along = Vec3(1, 0, 0);
  CHECK(refusal(plane, along).find("only for a volume mesh") != std::string::npos);
}

TEST_CASE("a table with three components moves nodes by number and by place, the others stay") {
  const Mesh mesh = cavity_mesh(Volumes::mixed);
  const Names body{"cavity"};
  const auto nodes = mesh.topology->markers().nodes_of(body);
  const Vec3 near = mesh.coordinates.xyz(nodes[9]) + Vec3(1e-8, 0, -1e-8);
  DisplacementTable table;
  table.source = "d.csv";
  table.entries.push_back({nodes[4], {0, 0}, {0.01, 0.02, -0.03}, 2});
  table.entries.push_back({std::nullopt, near, {-0.02, 0, 0.01}, 3});
  for (const double fraction : {0.5, 1.0}) {
    const Coordinates x = moved(mesh, body, table, fraction);
    for (Index node = 0; node < mesh.coordinates.size(); ++node) {
      Vec3 expected(0, 0, 0);
      if (node == nodes[4]) expected = fraction * Vec3(0.01, 0.02, -0.03);
      if (node == nodes[9]) expected = fraction * Vec3(-0.02, 0, 0.01);
      CHECK((way(mesh, x, node) - expected).norm() < 1e-15);
    }
  }
  table.entries[1].position.z() += 0.01;
  CHECK_THROWS_AS(moved(mesh, body, table, 1), UsageError);
  table.entries[1].position = Vec2(near.head<2>());
  CHECK_THROWS_AS(moved(mesh, body, table, 1), UsageError);
  table.entries.pop_back();
  table.entries[0].displacement = Vec2(0.01, 0.02);
  const std::string message = "d.csv:2: node " + std::to_string(nodes[4]) +
                              " has no dz: found a table for plane meshes, expected "
                              "node,dx,dy,dz or x,y,z,dx,dy,dz";
  CHECK_THROWS_WITH_AS(moved(mesh, body, table, 1), message.c_str(), UsageError);
}

TEST_CASE("volume meshes stay valid under deformations") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const MeshState state = make_state(cavity_mesh(volumes));
    DeformCommand command;
    command.markers = {"cavity"};
    SineDeformation sine{0.08, 1, {0, 0, 1}, Fade::end, 0.3};
    sine.along = Vec3(1, 0, 0);
    command.shape = sine;
    const CommandResult result = execute(command, state);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(result.smooth.inverted == 0);
    const Coordinates target = moved(state.mesh, {"cavity"}, sine, 1);
    const Names body{"cavity"}, all{"cavity", "outer"};
    const auto held = state.mesh.topology->markers().nodes_of(all);
    for (const Index node : held) CHECK(result.state.mesh.coordinates.same_place(node, target));
  }
}
