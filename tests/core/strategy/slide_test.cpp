#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/periodic_meshes.h"
#include "support/space_meshes.h"

namespace winslow::test {
namespace {

double worst(const Mesh& mesh) {
  return measure_quality(mesh).of(Metric::normalized_jacobian).statistics.min;
}

/// Boundary nodes of a square moved along their sides, by up to a share of a cell.
void shift_along_sides(Mesh& mesh, Index n, Random& random, double share) {
  for (Index node = 0; node < mesh.coordinates.size(); ++node) {
    if (!mesh.topology->on_boundary(node)) continue;
    Vec2 p = mesh.coordinates.xy(node);
    for (int k = 0; k < 2; ++k)
      if (p[k] > 1e-9 && p[k] < 1 - 1e-9) p[k] += share / n * random.uniform(-1, 1);
    mesh.coordinates.set_xy(node, p);
  }
}

/// m by n squares of size 1/8, without columns `left` to `right` (exclusive) up to `height`;
/// markers floor, gate, rest.
MeshData channel_with_gate(Index m, Index n, Index left, Index right, Index height) {
  MeshData data;
  std::map<std::pair<Index, Index>, Index> ids;
  const auto id = [&](Index i, Index j) {
    const auto [place, is_new] = ids.try_emplace({i, j}, data.node_count());
    if (is_new) data.coordinates.push_xy(Vec2(i, j) / 8);
    return place->second;
  };
  const auto solid = [&](Index i, Index j) { return i >= left && i < right && j < height; };
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < m; ++i)
      if (!solid(i, j))
        data.add_element(ElementType::quadrilateral,
                         std::array{id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
  Marker floor{"floor", 1, {}}, gate{"gate", 2, {}}, rest{"rest", 3, {}};
  for (Index i = 0; i < m; ++i) {
    if (!solid(i, 0)) floor.faces.emplace_back(id(i, 0), id(i + 1, 0));
    rest.faces.emplace_back(id(i, n), id(i + 1, n));
  }
  for (Index j = 0; j < n; ++j)
    for (const Index i : {Index{0}, m}) rest.faces.emplace_back(id(i, j), id(i, j + 1));
  for (Index j = 0; j < height; ++j)
    for (const Index i : {left, right}) gate.faces.emplace_back(id(i, j), id(i, j + 1));
  for (Index i = left; i < right; ++i) gate.faces.emplace_back(id(i, height), id(i + 1, height));
  data.markers = {floor, gate, rest};
  return data;
}

}  // namespace

TEST_CASE("a square whose sides slide is smoothed to its squares, from shifted nodes") {
  constexpr Index n = 8;
  const Mesh regular = make_mesh(square(n, Cells::quads));
  Mesh mesh = regular;
  Random random(6);
  shift_along_sides(mesh, n, random, 0.4);
  perturb(mesh, random, 0.3);
  SmoothCommand command;
  command.smooth.targets = TargetBlend::regular();
  const CommandResult held = execute(command, make_state(mesh));
  command.smooth.slide.markers = {"bottom", "top", "left", "right"};
  const CommandResult result = execute(command, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(largest_difference(result.state.mesh.coordinates, regular.coordinates) < 1e-8);
  CHECK(worst(result.state.mesh) > worst(held.state.mesh));
  REQUIRE(result.smooth.boundary.sliding.size() == 4);
  for (const SlidingPart& part : result.smooth.boundary.sliding) {
    CHECK(part.nodes.size() == n - 1);
    for (const Index node : part.nodes) {  // on its side to the last bit
      const Vec2 p = result.state.mesh.coordinates.xy(node);
      CHECK((part.marker == "bottom" || part.marker == "top" ? p.y() : p.x()) ==
            (part.marker == "top" || part.marker == "right" ? 1 : 0));
    }
  }
}

TEST_CASE("a body that turns takes a far field along that slides: the mesh turns as a whole") {
  const Mesh mesh = make_mesh(conformal_annulus(24, 8));
  for (const double angle : {90.0, 360.0}) {
    CAPTURE(angle);
    MoveCommand move;
    move.bodies[0].markers = {"inner"};
    move.bodies[0].motion.rotate = angle;
    move.bodies[0].motion.pivot = Vec2(0, 0);
    move.smooth.targets = TargetBlend::regular();
    move.smooth.slide.markers = {"outer"};
    const CommandResult result = execute(move, make_state(mesh));
    CHECK(result.smooth.converged);
    CHECK(result.smooth.fraction_reached == 1);
    Coordinates turned = mesh.coordinates;
    const Eigen::Rotation2D<double> turn(radians(angle));
    for (Index node = 0; node < turned.size(); ++node) turned.set_xy(node, turn * turned.xy(node));
    // The smoothed mesh at rest is the solution that turns; this one is smooth as it is made.
    SmoothCommand smooth;
    smooth.smooth = move.smooth;
    const CommandResult rest = execute(smooth, make_state(mesh));
    for (Index node = 0; node < turned.size(); ++node)
      turned.set_xy(node, turn * rest.state.mesh.coordinates.xy(node));
    CHECK(largest_difference(result.state.mesh.coordinates, turned) < 1e-7);
  }
}

TEST_CASE("in space planes stay plane to round-off, and a body that moves draws nodes along them") {
  const Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::tetrahedra));
  MoveCommand move;
  move.bodies[0].markers = {"cavity"};
  move.bodies[0].motion.translate = Vec2(0.12, 0);
  const CommandResult held = execute(move, make_state(mesh));
  move.smooth.slide.markers = {"outer"};
  const CommandResult result = execute(move, make_state(mesh));
  REQUIRE(result.smooth.converged);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(result.smooth.boundary.sliding.size() == 6);
  double drawn = 0;
  for (const SlidingPart& part : result.smooth.boundary.sliding) {
    for (const Index node : part.nodes) {
      const Vec3 before = mesh.coordinates.xyz(node),
                 after = result.state.mesh.coordinates.xyz(node);
      double across = 1;  // the distance from the plane that it came from
      for (int k = 0; k < 3; ++k)
        if (before[k] < 1e-9 || before[k] > 1 - 1e-9)
          across = std::min(across, std::abs(after[k] - before[k]));
      CHECK(across < 1e-15);
      drawn = std::max(drawn, (after - before).norm());
    }
  }
  CHECK(drawn > 0.01);
  const auto mean_aspect = [](const Mesh& of) {
    return measure_quality(of).of(Metric::aspect_ratio).statistics.avg;
  };
  CHECK(mean_aspect(result.state.mesh) < mean_aspect(held.state.mesh));
}

TEST_CASE("a gate moves along a floor that slides, and not off it") {
  // A channel of square cells without those of the gate.
  const Mesh mesh = make_mesh(channel_with_gate(24, 8, 6, 9, 3));
  MoveCommand move;
  move.bodies[0].markers = {"gate"};
  move.bodies[0].motion.translate = Vec2(1, 0);
  CHECK(execute(move, make_state(mesh)).smooth.contact);
  move.smooth.slide.markers = {"floor"};
  const CommandResult result = execute(move, make_state(mesh));
  REQUIRE(result.smooth.converged);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(worst(result.state.mesh) > 0.4);
  std::size_t on_floor = 0;
  for (const SlidingPart& part : result.smooth.boundary.sliding)
    for (const Index node : part.nodes) {
      CHECK(result.state.mesh.coordinates.xy(node).y() == 0);
      ++on_floor;
    }
  CHECK(on_floor == 24 - 3 - 2);
  move.bodies[0].motion.translate = Vec2(1, 0.05);
  CHECK_THROWS_WITH_AS(execute(move, make_state(mesh)),
                       doctest::Contains("takes the node off it by 0.05"), UsageError);
  // What does not slide is still in the way.
  move.bodies[0].motion.translate = Vec2(2.5, 0);
  const CommandResult far = execute(move, make_state(mesh));
  CHECK(far.smooth.contact);
}

TEST_CASE("a body moves along a sliding floor in space") {
  constexpr Index n = 6;
  MeshData data = cubes_with_holes(n, Volumes::tetrahedra, [](Index i, Index j, Index k) {
    return i >= 1 && i < 3 && j >= 2 && j < 4 && k < 2;
  });
  mark_volume(data, [](const Vec3& p) {
    const bool sides = (p.array().head<2>() < 1e-9).any() || (p.array() > 1 - 1e-9).any();
    return p.z() < 1e-9 ? "floor" : sides ? "box" : "body";
  });
  const Mesh mesh = make_mesh(data);
  MoveCommand move;
  move.bodies[0].markers = {"body"};
  move.bodies[0].motion.translate = Vec2(0.3, 0);
  move.smooth.slide.markers = {"floor"};
  const CommandResult result = execute(move, make_state(mesh));
  REQUIRE(result.smooth.converged);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(result.smooth.inverted == 0);
  for (const SlidingPart& part : result.smooth.boundary.sliding)
    for (const Index node : part.nodes) CHECK(result.state.mesh.coordinates.xyz(node).z() == 0);
}

TEST_CASE("with sliding nodes, too, the result is the same at one thread and at three") {
  const Mesh mesh = make_mesh(annulus(20, 6, 1.25, Cells::mixed));
  MoveCommand move;
  move.bodies[0].markers = {"inner"};
  move.bodies[0].motion.rotate = 40;
  move.bodies[0].motion.translate = Vec2(0.2, 0.1);
  move.smooth.slide.markers = {"outer"};
  move.smooth.threads = 1;
  const CommandResult one = execute(move, make_state(mesh));
  move.smooth.threads = 3;
  const CommandResult three = execute(move, make_state(mesh));
  CHECK(one.smooth.converged);
  CHECK(one.state.mesh.coordinates == three.state.mesh.coordinates);
}

TEST_CASE("a tangled interior is untangled while the boundary slides") {
  Mesh mesh = make_mesh(square(8, Cells::triangles));
  Random random(8);
  tangle(mesh, random);
  SmoothCommand command;
  command.smooth.slide.markers = {"bottom", "top", "left", "right"};
  const CommandResult result = execute(command, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
}

TEST_CASE("periodic sides keep matching, and a mesh that repeats itself is smoothed to one") {
  // Rings of a sector: whatever the angles at which they are cut, the smoothed mesh is the same at
  // every angle.
  const Mesh regular = make_mesh(sector(60, 6, 5, Vec2(0, 0)));
  Mesh mesh = regular;
  Random random(12);
  perturb(mesh, random, 0.3);
  const auto pairs = PeriodicPairs::find(*mesh.topology, mesh.coordinates, "begin", "end");
  for (const auto& [node, image] : pairs.pairs) {
    const Vec2 p = mesh.coordinates.xy(node) + 0.03 * random.vector();
    mesh.coordinates.set_xy(node, p);
    mesh.coordinates.set_xy(image, pairs.image.of({p.x(), p.y(), 0}).head<2>());
  }
  SmoothCommand command;
  command.smooth.targets = TargetBlend::regular();
  command.smooth.slide.periodic = {"begin", "end"};
  const CommandResult result = execute(command, make_state(mesh));
  REQUIRE(result.smooth.converged);
  REQUIRE(result.smooth.boundary.periodic.size() == 1);
  CHECK(result.smooth.boundary.periodic[0].pairs.size() == 4);
  const Coordinates& x = result.state.mesh.coordinates;
  for (Index ring = 0; ring <= 5; ++ring) {
    for (Index j = 0; j <= 6; ++j) {
      const Vec2 p = x.xy(ring * 7 + j), first = x.xy(ring * 7);
      CHECK((p - Eigen::Rotation2D<double>(radians(10.0 * j)) * first).norm() < 1e-8);
    }
  }
  for (const auto& [node, image] : result.smooth.boundary.periodic[0].pairs) {
    const Vec2 p = x.xy(node);
    CHECK((pairs.image.of({p.x(), p.y(), 0}).head<2>() - x.xy(image)).norm() < 1e-14);
  }
}

TEST_CASE("a body in a periodic passage goes farther than one between sides that stay") {
  const Mesh mesh = make_mesh(square_with_periodic_sides(10));
  MoveCommand move;
  move.bodies[0].markers = {"hole"};
  move.bodies[0].motion.translate =
      Vec2(0.5, 0);  // beyond the right side, where it comes from the left
  const CommandResult held = execute(move, make_state(mesh));
  CHECK(held.smooth.fraction_reached < 1);
  CHECK(held.smooth.contact.has_value());
  move.smooth.slide.periodic = {"left", "right"};
  const CommandResult result = execute(move, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(result.smooth.inverted == 0);
}

TEST_CASE("what does not go with sliding is refused by name") {
  const MeshState state = make_state(make_mesh(square_with_hole(10, Cells::triangles)));
  SmoothCommand smooth;
  smooth.smooth.slide.markers = {"lid"};
  CHECK_THROWS_WITH_AS(execute(smooth, state), doctest::Contains("lid"), UsageError);
  smooth.smooth.slide.markers = {"outer"};
  smooth.smooth.formulation = Formulation::pointwise;
  CHECK_THROWS_WITH_AS(execute(smooth, state), doctest::Contains("slide:"), UsageError);
  smooth.smooth.formulation = Formulation::variational;
  smooth.smooth.untangle = Untangle::picard;
  CHECK_THROWS_WITH_AS(execute(smooth, state), doctest::Contains("slide:"), UsageError);
  smooth.smooth.untangle = Untangle::automatic;
  smooth.smooth.slide.feature_angle = 200;
  CHECK_THROWS_WITH_AS(execute(smooth, state), doctest::Contains("feature_angle"), UsageError);
  MoveCommand move;
  move.bodies[0].markers = {"hole"};
  move.bodies[0].motion.rotate = 5;
  move.smooth.slide.markers = {"hole"};
  CHECK_THROWS_WITH_AS(execute(move, state), doctest::Contains("the motion takes its nodes"),
                       UsageError);
  smooth.smooth.slide = {};
  smooth.smooth.slide.periodic = {"outer"};
  CHECK_THROWS_WITH_AS(execute(smooth, state), doctest::Contains("expected pairs"), UsageError);
}

}  // namespace winslow::test
