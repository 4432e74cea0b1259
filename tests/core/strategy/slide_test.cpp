#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/command/command.h"
#include "core/error.h"
#include "core/motion/node_table.h"
#include "core/quality/quality.h"
#include "core/session/deformer.h"
#include "core/strategy/sliding.h"
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
  move.smooth.slide.fixed = {"floor"};
  CHECK(execute(move, make_state(mesh)).smooth.contact);
  move.smooth.slide.fixed.clear();
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

namespace {

/// A move of the body of box_with_body_on_two_planes().
MoveCommand body_moved(const Vec3& by) {
  MoveCommand move;
  move.bodies[0].markers = {"body"};
  move.bodies[0].motion.translate = by;
  move.smooth.targets = TargetBlend::regular();
  move.smooth.tolerance = 1e-10;
  return move;
}

}  // namespace

TEST_CASE("planes under a body give way by themselves, and so does the edge between them") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(box_with_body_on_two_planes(6, volumes));
    const CommandResult result = execute(body_moved({0.2, 0, 0}), make_state(mesh));
    REQUIRE(result.smooth.converged);
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(result.smooth.inverted == 0);
    CHECK(result.smooth.boundary.footholds.size() == 4);
    const auto on = [&](const char* marker, int axis) {
      for (const Index node :
           mesh.topology->markers().nodes(*mesh.topology->markers().find(marker)))
        CHECK(result.state.mesh.coordinates.xyz(node)[axis] == 0);
    };
    on("side", 1);
    on("floor", 2);
    std::size_t moved = 0;
    for (const SlidingPart& part : result.smooth.boundary.sliding) {
      CHECK(part.gives_way);
      for (const Index node : part.nodes)
        if (!mesh.coordinates.same_place(node, result.state.mesh.coordinates)) ++moved;
    }
    CHECK(moved > 20);
    // As with the options that say so.
    MoveCommand named = body_moved({0.2, 0, 0});
    named.smooth.slide.markers = {"side", "floor"};
    const CommandResult same = execute(named, make_state(mesh));
    CHECK(largest_difference(same.state.mesh.coordinates, result.state.mesh.coordinates) < 1e-8);
    named.smooth.slide.features = true;
    const CommandResult by_options = execute(named, make_state(mesh));
    CHECK(by_options.smooth.boundary.footholds.empty());
    CHECK(largest_difference(by_options.state.mesh.coordinates, result.state.mesh.coordinates) <
          1e-8);
  }
}

TEST_CASE("a body that slid stays on its planes: in two steps it gets where one takes it") {
  const MeshState state =
      make_state(make_mesh(box_with_body_on_two_planes(6, Volumes::tetrahedra)));
  const CommandResult once = execute(body_moved({0.16, 0, 0}), state);
  const CommandResult half = execute(body_moved({0.08, 0, 0}), state);
  const CommandResult twice = execute(body_moved({0.08, 0, 0}), half.state);
  CHECK(twice.smooth.boundary.footholds.size() == 4);
  CHECK(largest_difference(twice.state.mesh.coordinates, once.state.mesh.coordinates) < 1e-7);
  Deformer deformer(state, {.smooth = body_moved({0, 0, 0}).smooth});
  for (const double x : {0.05, 0.16, 0.1, 0.16}) {
    deformer.set_motion(body_moved({x, 0, 0}).bodies);
    const CommandResult now = deformer.step();
    CHECK(now.smooth.fraction_reached == 1);
    if (x == 0.16)
      CHECK(largest_difference(now.state.mesh.coordinates, once.state.mesh.coordinates) < 1e-7);
  }
}

TEST_CASE("what still holds a body is named, with its nodes and the option") {
  const MeshState state =
      make_state(make_mesh(box_with_body_on_two_planes(6, Volumes::tetrahedra)));
  MoveCommand move = body_moved({0.25, 0, 0});
  move.smooth.slide.fixed = {"floor"};
  RunOptions whole;
  whole.all_or_nothing = true;
  const CommandResult held = execute(move, state, whole);
  CHECK(held.smooth.fraction_reached == 0);
  CHECK(why_incomplete(held.smooth)
            .find("; body shares 7 nodes with floor, which stays (--fixed "
                  "floor)") != std::string::npos);
  for (const SlidingPart& part : held.smooth.boundary.sliding) CHECK(part.marker == "side");

  move.smooth.slide.fixed.clear();
  move.smooth.formulation = Formulation::pointwise;
  const CommandResult pointwise = execute(move, state, whole);
  CHECK(pointwise.smooth.boundary.sliding.empty());
  CHECK(why_incomplete(pointwise.smooth).find("the pointwise form") != std::string::npos);
}

TEST_CASE("a motion off what a body stands on is refused before anything is solved") {
  const MeshState state =
      make_state(make_mesh(box_with_body_on_two_planes(6, Volumes::tetrahedra)));
  CHECK_THROWS_WITH_AS(execute(body_moved({0.1, 0.05, 0}), state),
                       doctest::Contains("body shares 7 nodes with side (plane), and the motion "
                                         "takes them off it, node "),
                       UsageError);
  CHECK_THROWS_WITH_AS(execute(body_moved({0.1, 0, 0.05}), state),
                       doctest::Contains("move floor as well, or name it in fixed (--fixed floor)"),
                       UsageError);
  // With both fixed the motion is the user's own, as far as the cells allow.
  MoveCommand fixed = body_moved({0.01, 0.01, 0});
  fixed.smooth.slide.fixed = {"side", "floor"};
  CHECK(execute(fixed, state).smooth.fraction_reached == 1);

  MeshData data = box_with_body_on_two_planes(6, Volumes::hexahedra);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec3 p = data.coordinates.xyz(i);
    data.coordinates.set_xyz(i, p + Vec3(0, 0, 0.1 * std::sin(3 * p.x()) * p.y() * (1 - p.z())));
  }
  CHECK_THROWS_WITH_AS(execute(body_moved({0.1, 0, 0}), make_state(make_mesh(data))),
                       doctest::Contains("which is no plane, cylinder or sphere there"),
                       UsageError);
}

TEST_CASE("in the plane lines and circles under a body give way") {
  const Mesh square_mesh = make_mesh(square(8, Cells::triangles));
  MoveCommand piston;
  piston.bodies[0].markers = {"bottom"};
  piston.bodies[0].motion.translate = Vec2(0, 0.5);
  const CommandResult pressed = execute(piston, make_state(square_mesh));
  REQUIRE(pressed.smooth.converged);
  CHECK(pressed.smooth.fraction_reached == 1);
  for (const SlidingPart& part : pressed.smooth.boundary.sliding) {
    CHECK(part.gives_way);
    CHECK(part.nodes.size() == 7);
  }
  piston.bodies[0].motion.translate = Vec2(0.1, 0.5);
  CHECK_THROWS_WITH_AS(execute(piston, make_state(square_mesh)),
                       doctest::Contains("bottom shares 1 node with"), UsageError);

  const Mesh ring = make_mesh(sector(60, 12, 4, Vec2(0, 0)));
  MoveCommand turn;
  turn.bodies[0].markers = {"begin"};
  turn.bodies[0].motion.rotate = 30;
  turn.bodies[0].motion.pivot = Vec2(0, 0);
  const CommandResult turned = execute(turn, make_state(ring));
  REQUIRE(turned.smooth.converged);
  CHECK(turned.smooth.fraction_reached == 1);
  for (const SlidingPart& part : turned.smooth.boundary.sliding)
    for (const Index node : part.nodes)
      CHECK(turned.state.mesh.coordinates.xy(node).norm() ==
            doctest::Approx(part.marker == "inner" ? 1 : 2).epsilon(1e-12));
}

TEST_CASE("nothing gives way to nodes that stay, or to bodies that stand on nothing") {
  const MeshState state = make_state(make_mesh(square(8, Cells::triangles)));
  DeformCommand deform;
  deform.markers = {"bottom"};
  SineDeformation sine;
  sine.amplitude = 0.05;
  sine.fade = Fade::both;
  deform.shape = sine;
  const CommandResult free = execute(deform, state);
  CHECK(free.smooth.boundary.footholds.empty());
  deform.smooth.slide.fixed = {"left", "right"};
  CHECK(execute(deform, state).state.mesh.coordinates == free.state.mesh.coordinates);

  MoveCommand move;
  move.bodies[0].markers = {"hole"};
  move.bodies[0].motion.rotate = 10;
  const CommandResult alone =
      execute(move, make_state(make_mesh(square_with_hole(10, Cells::triangles))));
  CHECK(alone.smooth.boundary.footholds.empty());
  CHECK(alone.smooth.boundary.sliding.empty());
}

namespace {

/// A table that moves all nodes of markers.
DeformCommand nodes_moved(const Mesh& mesh, const std::vector<std::string>& markers,
                          const Vec3& by) {
  const int dimension = mesh.coordinates.dimension();
  DisplacementTable table;
  for (const Index node : mesh.topology->markers().nodes_of(markers))
    table.entries.push_back({node, {}, GivenVector::of(dimension, by)});
  DeformCommand deform;
  deform.shape = table;
  return deform;
}

std::vector<std::string> markers_that_give_way(const CommandResult& result) {
  std::vector<std::string> names;
  for (const SlidingPart& part : result.smooth.boundary.sliding)
    if (part.gives_way) names.push_back(part.marker);
  sort_unique(names);
  return names;
}

}  // namespace

TEST_CASE(
    "a table that names all nodes of a marker moves a body, which what it stands on gives way to") {
  // Two gates on a floor and a gap between them that is one element wide: the nodes of the floor
  // there are all of gates.
  MeshData gates = grid_with_holes(12, Cells::triangles,
                                   [](Index i, Index j) { return (i == 4 || i == 6) && j < 3; });
  mark_boundary(gates, [](const Vec2& p) {
    const bool rest = p.x() < 1e-9 || p.x() > 1 - 1e-9 || p.y() > 1 - 1e-9;
    return rest ? "rest" : p.y() < 1e-9 ? "floor" : p.x() < 0.48 ? "front" : "back";
  });
  struct Case {
    Mesh mesh;
    std::vector<std::string> bodies, footing;
  };
  const std::vector<Case> cases{
      {make_mesh(gates), {"front", "back"}, {"floor"}},
      {make_mesh(box_with_body_on_two_planes(6, Volumes::tetrahedra)), {"body"}, {"floor", "side"}},
      {make_mesh(box_with_body_on_two_planes(6, Volumes::mixed)), {"body"}, {"floor", "side"}}};
  for (const Case& c : cases) {
    CAPTURE(c.mesh.topology->node_count());
    const MeshState state = make_state(c.mesh);
    DeformCommand deform = nodes_moved(c.mesh, c.bodies, {0.12, 0, 0});
    const CommandResult result = execute(deform, state);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(markers_that_give_way(result) == c.footing);
    CHECK(markers_moved_by(*c.mesh.topology, c.mesh.topology->markers().nodes_of(c.bodies)) ==
          c.bodies);
    // As with the markers by name.
    deform.markers = c.bodies;
    CHECK(execute(deform, state).state.mesh.coordinates == result.state.mesh.coordinates);
  }

  // A table that moves a face of the floor by itself says where the floor goes.
  const Mesh& mesh = cases.front().mesh;
  DeformCommand deform = nodes_moved(mesh, {"front", "back"}, {0.01, 0, 0});
  auto& entries = std::get<DisplacementTable>(deform.shape).entries;
  std::vector<Index> named =
      mesh.topology->markers().nodes_of(std::vector<std::string>{"front", "back"});
  for (Index node = 0; node < mesh.coordinates.size(); ++node) {
    const Vec2 p = mesh.coordinates.xy(node);
    if (p.y() > 0 || p.x() < 0.7 || p.x() > 0.9) continue;
    entries.push_back({node, {}, Vec2(0.005, 0)});
    named.push_back(node);
  }
  sort_unique(named);
  CHECK(markers_moved_by(*mesh.topology, named) ==
        std::vector<std::string>{"floor", "front", "back"});
  const CommandResult driven = execute(deform, make_state(mesh));
  CHECK(driven.smooth.fraction_reached == 1);
  CHECK(markers_that_give_way(driven).empty());
  // Single nodes of a floor are no body.
  DeformCommand single = nodes_moved(mesh, {"front"}, {0.005, 0, 0});
  std::get<DisplacementTable>(single.shape).entries.resize(1);
  CHECK(markers_that_give_way(execute(single, make_state(mesh))).empty());
}

TEST_CASE("fixed markers are checked by name") {
  const MeshState state = make_state(make_mesh(box_with_body_on_two_planes(3, Volumes::hexahedra)));
  MoveCommand move = body_moved({0.02, 0, 0});
  const auto refused = [&](const std::string& name, const char* words) {
    move.smooth.slide.fixed = {name};
    CHECK_THROWS_WITH_AS(execute(move, state), doctest::Contains(words), UsageError);
  };
  refused("lid", "lid");
  refused("body", "to be fixed and to move");
  move.smooth.slide.markers = {"side"};
  refused("side", "to be fixed and to slide");
}

}  // namespace winslow::test
