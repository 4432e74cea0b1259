#include "core/motion/transfer.h"

#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("a transfer follows a rigid motion as such and ends exactly at its target") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  const RigidMotion whole{130, Vec2(0.3, 0.1), Vec2(0.2, -0.4)};
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, {"inner"}, whole);
  Coordinates to = mesh.coordinates;
  motion->apply(mesh.coordinates, 1, to);
  const auto transfer = make_transfer(NodeClasses(mesh.topology), mesh.coordinates, to);
  CHECK(transfer->nodes().size() == 16);
  Coordinates x = mesh.coordinates;
  transfer->apply(mesh.coordinates, 1, x);
  for (const Index node : transfer->nodes()) CHECK(x.xy(node) == to.xy(node));
  // Half-way the body has its shape and half the angle.
  transfer->apply(mesh.coordinates, 0.5, x);
  const auto nodes = transfer->nodes();
  const Vec2 before = mesh.coordinates.xy(nodes[1]) - mesh.coordinates.xy(nodes[0]);
  const Vec2 after = x.xy(nodes[1]) - x.xy(nodes[0]);
  CHECK(after.norm() == doctest::Approx(before.norm()));
  const double angle =
      std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  CHECK(angle == doctest::Approx(radians(65)));
}

TEST_CASE("a transfer carries a change of shape along") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  Coordinates to = mesh.coordinates;
  const Index marker = *mesh.topology->markers().find("inner");
  for (const Index node : mesh.topology->markers().nodes(marker)) {
    to.set_xy(node, Vec2(1.2 * to.xy(node).x(), 0.9 * to.xy(node).y()));
  }
  const auto transfer = make_transfer(NodeClasses(mesh.topology), mesh.coordinates, to);
  Coordinates x = mesh.coordinates;
  transfer->apply(mesh.coordinates, 0.5, x);
  for (const Index node : transfer->nodes()) {
    const Vec2 middle = 0.5 * (mesh.coordinates.xy(node) + to.xy(node));
    CHECK((x.xy(node) - middle).norm() < 1e-12);
  }
}

TEST_CASE("nothing to do is no motion") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  const auto transfer =
      make_transfer(NodeClasses(mesh.topology), mesh.coordinates, mesh.coordinates);
  CHECK(transfer->nodes().empty());
}

namespace {

Mesh ring() { return make_mesh(annulus(48, 12, 1.15, Cells::triangles)); }

std::span<const Index> nodes_of(const Mesh& mesh, const char* marker) {
  const Markers& markers = mesh.topology->markers();
  return markers.nodes(*markers.find(marker));
}

std::vector<std::vector<Index>> bodies_of(std::span<const Index> nodes) {
  return {std::vector<Index>(nodes.begin(), nodes.end())};
}

}  // namespace

TEST_CASE("between two meshes of a turn there is one for every degree, valid, the body exact") {
  const Mesh before = ring();
  MoveCommand move;
  move.bodies[0].markers = {"inner"};
  move.bodies[0].motion.rotate = 12;
  const Mesh after = execute(move, make_state(before)).state.mesh;
  const auto nodes = nodes_of(before, "inner");
  const auto between =
      meshes_between(*before.topology, bodies_of(nodes), before.coordinates, after.coordinates);
  REQUIRE(between.size() == 11);
  for (std::size_t k = 0; k < between.size(); ++k) {
    INFO("mesh ", k);
    CHECK(check_validity(*before.topology, between[k]).inverted == 0);
    const RigidMotion turn{static_cast<double>(k + 1), Vec2(0, 0), Vec2(0, 0)};
    for (const Index node : nodes)
      CHECK((between[k].xy(node) - transform(turn, before.coordinates.xy(node))).norm() < 1e-9);
    for (const Index node : nodes_of(before, "outer"))
      CHECK(between[k].xy(node) == before.coordinates.xy(node));
  }
}

TEST_CASE("in space, too: the body turns about its axis, and the box around it stays") {
  const Mesh before = box_with_body(5, Volumes::mixed);
  MoveCommand move;
  move.bodies[0].markers = {"body"};
  move.bodies[0].motion.rotate = 12;
  move.bodies[0].motion.axis = Vec3(1, -1, 0.5);
  const Mesh after = execute(move, make_state(before)).state.mesh;
  const auto nodes = nodes_of(before, "body");
  const auto between =
      meshes_between(*before.topology, bodies_of(nodes), before.coordinates, after.coordinates);
  REQUIRE(between.size() == 11);
  const Vec3 centre = space_bounds(before.coordinates, nodes).centre();
  for (std::size_t k = 0; k < between.size(); ++k) {
    INFO("mesh ", k);
    CHECK(check_validity(*before.topology, between[k]).inverted == 0);
    const RigidMotion turn{static_cast<double>(k + 1), centre, Vec3::Zero(),
                           *move.bodies[0].motion.axis};
    for (const Index node : nodes)
      CHECK((between[k].xyz(node) - transform(turn, before.coordinates.xyz(node))).norm() < 1e-9);
    for (const Index node : nodes_of(before, "far"))
      CHECK(between[k].xyz(node) == before.coordinates.xyz(node));
  }
}

TEST_CASE("between meshes of a shift there is one for every 2 % of the body; of no motion none") {
  const Mesh mesh = ring();
  const auto nodes = nodes_of(mesh, "inner");
  const double extent = bounds(mesh.coordinates, nodes).size().norm();
  MoveCommand move;
  move.bodies[0].markers = {"inner"};
  move.bodies[0].motion.translate = Vec2(0.1 * extent, 0);
  const Coordinates to = execute(move, make_state(mesh)).state.mesh.coordinates;
  CHECK(meshes_between(*mesh.topology, bodies_of(nodes), mesh.coordinates, to).size() == 4);
  CHECK(
      meshes_between(*mesh.topology, bodies_of(nodes), mesh.coordinates, mesh.coordinates).empty());
  CHECK(meshes_between(*mesh.topology, {}, mesh.coordinates, to).empty());
}

TEST_CASE("what would be invalid on the way is left out") {
  const Mesh mesh = ring();
  const auto nodes = nodes_of(mesh, "inner");
  // Turned upside down without the mesh: nothing in between is valid but the first few.
  Coordinates to = mesh.coordinates;
  for (const Index node : nodes)
    to.set_xy(node, transform({170, Vec2(0, 0), Vec2(0, 0)}, to.xy(node)));
  const auto between = meshes_between(*mesh.topology, bodies_of(nodes), mesh.coordinates, to);
  CHECK(between.size() < 89);
  for (const Coordinates& x : between) CHECK(check_validity(*mesh.topology, x).inverted == 0);
}

TEST_CASE("bodies that turn against each other are each where their own motion takes them") {
  const Mesh before = make_mesh(square_with_two_holes(20, Cells::triangles));
  MoveCommand move;
  move.bodies = {{{"hole_a"}, {.rotate = 10}}, {{"hole_b"}, {.rotate = -5}}};
  const Mesh after = execute(move, make_state(before)).state.mesh;
  std::vector<std::vector<Index>> bodies;
  for (const char* marker : {"hole_a", "hole_b"}) {
    const auto nodes = nodes_of(before, marker);
    bodies.emplace_back(nodes.begin(), nodes.end());
  }
  const auto between =
      meshes_between(*before.topology, bodies, before.coordinates, after.coordinates);
  REQUIRE(between.size() == 9);
  for (std::size_t k = 0; k < between.size(); ++k) {
    const double share = static_cast<double>(k + 1) / 10;
    const RigidMotion a{10 * share, Vec2(0.3, 0.5), Vec2(0, 0)};
    const RigidMotion b{-5 * share, Vec2(0.7, 0.5), Vec2(0, 0)};
    for (const Index node : bodies[0])
      CHECK((between[k].xy(node) - transform(a, before.coordinates.xy(node))).norm() < 1e-9);
    for (const Index node : bodies[1])
      CHECK((between[k].xy(node) - transform(b, before.coordinates.xy(node))).norm() < 1e-9);
  }
}

TEST_CASE("poses of a body that turns predict all its other poses, and what lies beside it") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  // The mesh follows a field of the angle that is no rigid motion: x + sin, cos of shares of it.
  const auto turned = [&](double angle) {
    Coordinates x = mesh.coordinates;
    for (Index node = 0; node < x.size(); ++node) {
      const Vec2 p = mesh.coordinates.xy(node);
      const double share = (3.375 - p.norm()) / 2.375;
      const double a = radians(angle) * share, c = std::cos(a), s = std::sin(a);
      x.set_xy(node, Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
    }
    return x;
  };
  const auto inner = mesh.topology->markers().nodes(*mesh.topology->markers().find("inner"));
  const std::vector<Coordinates> meshes{turned(15), turned(10), turned(5), turned(0)};
  const Coordinates target = turned(20);
  double before = 1;
  for (const std::size_t count : {2u, 3u, 4u}) {
    std::vector<const Coordinates*> known;
    for (std::size_t k = 0; k < count; ++k) known.push_back(&meshes[k]);
    const auto predicted = extrapolated(known, inner, target);
    REQUIRE(predicted);
    const double off = largest_difference(*predicted, target);
    CHECK(off < 0.3 * before);  // another order
    before = off;
    double at_body = 0;
    for (const Index node : inner)
      at_body = std::max(at_body, (predicted->xy(node) - target.xy(node)).norm());
    if (count == 3) CHECK(at_body < 1e-5);
  }
  CHECK(before < 2e-3);
}

TEST_CASE("a prediction has to reach the places of the nodes") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  const auto moved = [&](const Vec2& way) {
    Coordinates x = mesh.coordinates;
    for (Index node = 0; node < x.size(); ++node) x.set_xy(node, x.xy(node) + way);
    return x;
  };
  const auto nodes = mesh.topology->markers().nodes(*mesh.topology->markers().find("inner"));
  const Coordinates there = moved(Vec2(0.1, 0)), target = moved(Vec2(0.2, 0));
  const std::vector<const Coordinates*> known{&there, &mesh.coordinates};
  const auto along = extrapolated(known, nodes, target);
  REQUIRE(along);
  CHECK(largest_difference(*along, target) < 1e-14);
  CHECK_FALSE(extrapolated(known, nodes, moved(Vec2(0.1, 0.1))));
  CHECK_FALSE(extrapolated(std::span(known).first(1), nodes, target));
  CHECK(*extrapolated(known, nodes, there) == there);
}

TEST_CASE("a mesh is predicted from those with the nearest boundaries, none of them twice") {
  const Mesh mesh = make_mesh(annulus(16, 3, 1.5, Cells::triangles));
  const auto moved = [&](double way) {
    Coordinates x = mesh.coordinates;
    for (Index node = 0; node < x.size(); ++node) x.set_xy(node, x.xy(node) + Vec2(way, 0));
    return x;
  };
  const auto nodes = mesh.topology->markers().nodes(*mesh.topology->markers().find("inner"));
  const std::vector<double> ways{0.5, 0.4, 0.1, 0.401, 0.2, 0.4, 0};
  std::vector<Coordinates> meshes;
  for (const double way : ways) meshes.push_back(moved(way));
  std::vector<const Coordinates*> known;
  for (const Coordinates& one : meshes) known.push_back(&one);
  const auto chosen = nearest_meshes(known, nodes, moved(0.31), 3);
  // .4 is known twice, and .401 is too near to it.
  REQUIRE(chosen.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) CHECK(*chosen[k] == moved(std::array{0.4, 0.2, 0.5}[k]));
  CHECK(nearest_meshes(known, nodes, moved(0.31), 9).size() == 5);
  CHECK(nearest_meshes(known, nodes, moved(0.1), 9).front() == known[2]);
}
