#include "core/strategy/sliding.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "support/layered_meshes.h"
#include "support/meshes.h"
#include "support/periodic_meshes.h"

namespace winslow::test {
namespace {

/// Boundary edges of a marker by their two nodes, over the length of all of them: as chords.
std::map<std::pair<Index, Index>, double> shares(const Mesh& mesh, const Coordinates& x,
                                                 const std::string& marker,
                                                 const std::function<bool(Vec2)>& which) {
  std::map<std::pair<Index, Index>, double> out;
  double whole = 0;
  for (const Face& face :
       mesh.topology->markers()[at(*mesh.topology->markers().find(marker))].faces) {
    const auto [a, b] = face.edge();
    if (!which(0.5 * (mesh.coordinates.xy(a) + mesh.coordinates.xy(b)))) continue;
    whole += out[{a, b}] = (x.xy(a) - x.xy(b)).norm();
  }
  for (auto& [edge, length] : out) length /= whole;
  return out;
}

double largest_change(
    const Mesh& mesh, const Coordinates& x, const std::string& marker,
    const std::function<bool(Vec2)>& which = [](Vec2) { return true; }) {
  const auto before = shares(mesh, mesh.coordinates, marker, which);
  const auto after = shares(mesh, x, marker, which);
  double most = 0;
  for (const auto& [edge, share] : before)
    most = std::max(most, std::abs(after.at(edge) / share - 1));
  return most;
}

/// A channel, 3 by 1, with a gate 1/4 thick and 1/2 high that stands on its floor at x = 1; rows
/// are clustered at the floor, columns at the gate. Markers floor, gate, rest.
Mesh channel_with_clusters() {
  MeshData data;
  std::vector<double> columns, rows;
  for (int i = 0; i <= 10; ++i) columns.push_back(1 - std::pow(1 - i / 10.0, 1.6));
  for (int i = 1; i <= 3; ++i) columns.push_back(1 + i / 12.0);
  for (int i = 1; i <= 16; ++i) columns.push_back(1.25 + 1.75 * std::pow(i / 16.0, 1.6));
  for (int j = 0; j <= 8; ++j) rows.push_back(0.5 * std::pow(j / 8.0, 3));
  for (int j = 1; j <= 5; ++j) rows.push_back(0.5 + j / 10.0);
  const auto solid = [](Index i, Index j) { return i >= 10 && i < 13 && j < 8; };
  std::map<std::pair<Index, Index>, Index> ids;
  const auto id = [&](Index i, Index j) {
    const auto [place, is_new] = ids.try_emplace({i, j}, data.node_count());
    if (is_new) data.coordinates.push_xy(Vec2(columns[at(i)], rows[at(j)]));
    return place->second;
  };
  for (Index j = 0; j + 1 < static_cast<Index>(rows.size()); ++j)
    for (Index i = 0; i + 1 < static_cast<Index>(columns.size()); ++i)
      if (!solid(i, j))
        data.add_element(ElementType::quadrilateral,
                         std::array{id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
  mark_boundary(data, [](const Vec2& p) {
    if (p.y() < 1e-9) return "floor";
    if (p.y() > 1 - 1e-9 || p.x() < 1e-9 || p.x() > 3 - 1e-9) return "rest";
    return "gate";
  });
  return make_mesh(data);
}

}  // namespace

TEST_CASE("walls are what lies around a body, and what has flat elements") {
  const Mesh ring = make_mesh(annulus(24, 5, 1.3, Cells::triangles));
  CHECK(is_wall(ring, "inner"));
  CHECK_FALSE(is_wall(ring, "outer"));
  const Mesh channel = channel_with_clusters();
  CHECK(is_wall(channel, "floor"));
  CHECK_FALSE(is_wall(channel, "rest"));
  CHECK_THROWS_WITH_AS(is_wall(ring, "lid"), doctest::Contains("lid"), UsageError);
}

TEST_CASE("before a gate and behind it the nodes of a clustered floor keep their shares") {
  const Mesh mesh = channel_with_clusters();
  MoveCommand move;
  move.bodies[0].markers = {"gate"};
  move.bodies[0].motion.translate = Vec2(0.8, 0);
  move.smooth.slide.markers = {"floor"};
  const auto before = [](const Vec2& p) { return p.x() < 1; };
  const auto behind = [](const Vec2& p) { return p.x() > 1.25; };
  const CommandResult held = execute(move, make_state(mesh));
  REQUIRE(held.smooth.converged);
  CHECK(held.smooth.fraction_reached == 1);
  CHECK(held.smooth.inverted == 0);
  const Coordinates& x = held.state.mesh.coordinates;
  CHECK(largest_change(mesh, x, "floor", before) < 1e-12);
  CHECK(largest_change(mesh, x, "floor", behind) < 1e-12);
  REQUIRE(held.smooth.boundary.sliding.size() == 2);
  for (const SlidingPart& part : held.smooth.boundary.sliding) {
    CHECK(part.spacing == Spacing::ends);
    for (const Index node : part.nodes) CHECK(x.xy(node).y() == 0);
  }
  move.smooth.slide.spacing = SlideSpacing::free;
  const CommandResult free = execute(move, make_state(mesh));
  REQUIRE(free.smooth.converged);
  CHECK(largest_change(mesh, free.state.mesh.coordinates, "floor", before) > 0.05);
  move.smooth.slide.held_markers = {"floor"};
  CHECK(execute(move, make_state(mesh)).state.mesh.coordinates == x);
}

TEST_CASE("a closed wall turns as a whole and keeps its spacing, a far field does not") {
  // The far field turns, and takes the circle inside along, which is denser on one side.
  MeshData data = o_grid(40, distances(8, 0.1, 1.3, 8), Cut::none);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    const double phi = std::atan2(p.y(), p.x());
    const double to = phi - 0.35 * std::sin(phi);  // denser around phi = 0
    data.coordinates.set_xy(i, p.norm() * Vec2(std::cos(to), std::sin(to)));
  }
  const Mesh mesh = make_mesh(data);
  MoveCommand move;
  move.bodies[0].markers = {"farfield"};
  move.bodies[0].motion.rotate = 50;
  move.bodies[0].motion.pivot = Vec2(0, 0);
  move.smooth.targets = TargetBlend::regular();
  move.smooth.slide.markers = {"wall"};
  const CommandResult held = execute(move, make_state(mesh));
  REQUIRE(held.smooth.converged);
  REQUIRE(held.smooth.boundary.sliding.size() == 1);
  CHECK(held.smooth.boundary.sliding[0].spacing == Spacing::turns);
  CHECK(largest_change(mesh, held.state.mesh.coordinates, "wall") < 1e-12);
  // It went with the far field: the mesh at rest with its wall free to turn, turned.
  SmoothCommand smooth;
  smooth.smooth = move.smooth;
  const CommandResult rest = execute(smooth, make_state(mesh));
  Coordinates turned = rest.state.mesh.coordinates;
  const Eigen::Rotation2D<double> turn(radians(50));
  for (Index node = 0; node < turned.size(); ++node) turned.set_xy(node, turn * turned.xy(node));
  CHECK(largest_difference(held.state.mesh.coordinates, turned) < 1e-7);
  move.smooth.slide.spacing = SlideSpacing::free;
  const CommandResult free = execute(move, make_state(mesh));
  REQUIRE(free.smooth.converged);
  CHECK(largest_change(mesh, free.state.mesh.coordinates, "wall") > 0.05);
}

TEST_CASE("a held curve between corners that stay does not move, and Newton's method still ends") {
  const Mesh mesh = channel_with_clusters();
  SmoothCommand command;
  command.smooth.slide.markers = {"rest", "floor"};
  command.smooth.slide.spacing = SlideSpacing::held;
  const CommandResult result = execute(command, make_state(mesh));
  CHECK(result.smooth.converged);
  for (Index node = 0; node < mesh.coordinates.size(); ++node)
    if (mesh.topology->on_boundary(node))
      CHECK(mesh.coordinates.same_place(node, result.state.mesh.coordinates));
  for (const SlidingPart& part : result.smooth.boundary.sliding) {
    CHECK(part.spacing == Spacing::stays);
    CHECK(part.sliding_nodes() == 0);
  }
}

TEST_CASE("corners of a passage slide with the inlet, and the body takes the mesh along") {
  // Beyond its own place a body in a periodic passage comes to where it was: with floor and lid
  // sliding the mesh goes with it, and is what it was.
  const Mesh mesh = make_mesh(square_with_periodic_sides(10));
  MoveCommand move;
  move.bodies[0].markers = {"hole"};
  move.bodies[0].motion.translate = Vec2(1, 0);
  move.smooth.targets = TargetBlend::regular();
  move.smooth.slide.periodic = {"left", "right"};
  move.smooth.slide.markers = {"walls"};
  SmoothCommand smooth;
  for (const SlideSpacing spacing : {SlideSpacing::free, SlideSpacing::held}) {
    CAPTURE(static_cast<int>(spacing));
    move.smooth.slide.spacing = spacing;
    smooth.smooth = move.smooth;
    const CommandResult at_rest = execute(smooth, make_state(mesh));
    const CommandResult result = execute(move, make_state(mesh));
    REQUIRE(result.smooth.converged);
    CHECK(result.smooth.fraction_reached == 1);
    REQUIRE(result.smooth.boundary.periodic.size() == 1);
    CHECK(result.smooth.boundary.periodic[0].corners.size() == 2);
    Coordinates moved = at_rest.state.mesh.coordinates;
    for (Index node = 0; node < moved.size(); ++node)
      moved.set_xy(node, moved.xy(node) + Vec2(1, 0));
    CHECK(largest_difference(result.state.mesh.coordinates, moved) < 1e-7);
    const PeriodicPairs& pairs = result.smooth.boundary.periodic[0];
    for (const auto* list : {&pairs.pairs, &pairs.corners})
      for (const auto& [node, image] : *list)
        CHECK((result.state.mesh.coordinates.xy(image) - result.state.mesh.coordinates.xy(node) -
               Vec2(1, 0))
                  .norm() < 1e-12);
  }
}

TEST_CASE("a corner whose image is on nothing that slides is refused, one at a turn stays") {
  MeshData data = square(6, Cells::triangles);
  data.markers.clear();
  mark_boundary(data, [](const Vec2& p) {
    if (p.x() < 1e-9) return "left";
    if (p.x() > 1 - 1e-9) return "right";
    if (p.y() > 0.5) return "top";
    return p.x() < 0.5 ? "first" : "second";
  });
  SmoothCommand command;
  command.smooth.slide.periodic = {"left", "right"};
  command.smooth.slide.markers = {"first"};
  CHECK_THROWS_WITH_AS(execute(command, make_state(make_mesh(data))),
                       doctest::Contains("is on \"first\", which slides, and its image, node"),
                       UsageError);
  command.smooth.slide.markers = {"first", "second"};
  CHECK(execute(command, make_state(make_mesh(data))).smooth.boundary.periodic[0].corners.size() ==
        1);
  // A roof: at its eaves it turns by twice its slope.
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    data.coordinates.set_xy(i, {p.x(), p.y() + (1 - p.y()) * 0.5 * std::abs(p.x() - 0.5)});
  }
  const CommandResult stays = execute(command, make_state(make_mesh(data)));
  CHECK(stays.smooth.boundary.periodic[0].corners.empty());
  command.smooth.slide.held_markers = {"top"};
  CHECK_THROWS_WITH_AS(execute(command, make_state(make_mesh(data))),
                       doctest::Contains("does not slide"), UsageError);
}

}  // namespace winslow::test
