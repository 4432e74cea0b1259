#include "core/motion/node_table.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/command/command.h"
#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/motion/held_elements.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Names = std::vector<std::string>;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <typename Table>
std::unique_ptr<Motion> motion_of(const Mesh& mesh, const Names& names, const Table& table) {
  return make_motion(*mesh.topology, mesh.coordinates, names, table);
}

Coordinates applied(const Motion& motion, const Coordinates& rest, double fraction) {
  Coordinates out = rest;
  motion.apply(rest, fraction, out);
  return out;
}

template <typename Use>
std::string complaint_of(const Use& use) {
  try {
    use();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Mesh two_holes() { return make_mesh(square_with_two_holes(20, Cells::quads)); }

/// The unit square as a coupled mesh: the solid is its middle, its rim is the marker "wet" inside
/// the mesh, or has no marker.
Mesh coupled(bool marked, Cells cells = Cells::triangles) {
  MeshData data = square(15, cells);
  if (!marked) return make_mesh(data);
  Marker wet{"wet", 77, {}};
  const auto on = [&](Index node, int across, double value) {
    return std::abs(data.coordinates.xy(node)[across] - value) < 1e-9;
  };
  const auto within = [&](Index node, int along) {
    const double c = data.coordinates.xy(node)[along];
    return c > 0.4 - 1e-9 && c < 0.6 + 1e-9;
  };
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto corners = data.element(e);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Index a = corners[k], b = corners[(k + 1) % corners.size()];
      for (int across = 0; across < 2; ++across)
        for (const double value : {0.4, 0.6})
          if (on(a, across, value) && on(b, across, value) && within(a, 1 - across) &&
              within(b, 1 - across) && a < b)
            wet.faces.emplace_back(a, b);
    }
  }
  std::vector<Face> once;
  for (const Face& face : wet.faces)
    if (std::ranges::find(once, face) == once.end()) once.push_back(face);
  wet.faces = once;
  data.markers.push_back(wet);
  return make_mesh(data);
}

bool in_solid(const Vec3& p, int dimension) {
  for (int k = 0; k < dimension; ++k)
    if (std::abs(p[k] - 0.5) > 0.1 + 1e-9) return false;
  return true;
}

std::vector<Index> solid_of(const Mesh& mesh) {
  std::vector<Index> nodes;
  for (Index node = 0; node < mesh.coordinates.size(); ++node)
    if (in_solid(place_of(mesh.coordinates, node), mesh.coordinates.dimension()))
      nodes.push_back(node);
  return nodes;
}

/// Where a bent and sheared solid goes.
Vec3 bent(const Vec3& p) {
  return p + Vec3(0.1 + 0.5 * (p.y() - 0.5), 0.4 * (p.x() - 0.5) * (p.x() - 0.5) + 0.03, 0);
}

DisplacementTable bending(const Mesh& mesh) {
  const int dimension = mesh.coordinates.dimension();
  DisplacementTable table;
  for (const Index node : solid_of(mesh)) {
    const Vec3 p = place_of(mesh.coordinates, node);
    table.entries.push_back({node, {0, 0}, GivenVector::of(dimension, bent(p) - p), 0});
  }
  return table;
}

CommandResult executed(const Names& markers, const decltype(DeformCommand::shape)& shape,
                       const Mesh& mesh, const RunOptions& options = {}) {
  DeformCommand deform;
  deform.markers = markers;
  deform.shape = shape;
  return execute(deform, make_state(mesh), options);
}

RunOptions all_or_nothing() {
  RunOptions options;
  options.all_or_nothing = true;
  return options;
}

}  // namespace

TEST_CASE("a displacement table moves nodes by id and by position, the others stay") {
  const Mesh mesh = two_holes();
  const Names names{"hole_a"};
  const auto nodes = mesh.topology->markers().nodes_of(names);
  DisplacementTable table;
  table.entries.push_back({nodes[2], {0, 0}, {0.01, 0.02}, 3});
  // Positions as a file with six digits would give them.
  table.entries.push_back(
      {std::nullopt, mesh.coordinates.xy(nodes[5]) + Vec2(1e-8, -1e-8), {-0.01, 0}, 4});
  const auto motion = motion_of(mesh, names, table);
  for (const double fraction : {0.5, 1.0}) {
    const Coordinates out = applied(*motion, mesh.coordinates, fraction);
    for (Index i = 0; i < mesh.coordinates.size(); ++i) {
      Vec2 expected(0, 0);
      if (i == nodes[2]) expected = fraction * Vec2(0.01, 0.02);
      if (i == nodes[5]) expected = fraction * Vec2(-0.01, 0);
      CHECK((out.xy(i) - mesh.coordinates.xy(i) - expected).norm() < 1e-15);
    }
  }
}

TEST_CASE("of several nodes within the tolerance the nearest is taken") {
  // Nodes of the inner circle 1e-7 apart in a domain of size 2.
  MeshData data = annulus(8, 2, 2, Cells::quads);
  const Vec2 a = data.coordinates.xy(0);
  data.coordinates.set_xy(1, a + Vec2(0, 1e-7));
  const Mesh mesh = make_mesh(data);
  DisplacementTable table;
  table.entries.push_back({std::nullopt, a + Vec2(0, 0.9e-7), {1, 0}, 1});
  const auto motion = motion_of(mesh, {"inner"}, table);
  const Coordinates out = applied(*motion, mesh.coordinates, 1);
  CHECK(out.xy(0) == mesh.coordinates.xy(0));
  CHECK(out.xy(1).x() == doctest::Approx(a.x() + 1));
}

TEST_CASE("a table's refusals name file and line") {
  const Mesh mesh = two_holes();
  Names names{"hole_a"};
  const auto nodes = mesh.topology->markers().nodes_of(names);
  DisplacementTable table{{{nodes[0], {0, 0}, {0.1, 0}, 2}}, "wing.csv"};
  std::string expected;
  SUBCASE("the place of another marker's node") {
    const Names other{"hole_b"};
    const Index node = mesh.topology->markers().nodes_of(other)[0];
    table.entries.push_back({std::nullopt, mesh.coordinates.xy(node), {0, 0}, 6});
    expected = " is the place of node " + std::to_string(node) + ", which lies on \"hole_b\"";
  }
  SUBCASE("another marker's node") {
    const Names other{"hole_b"};
    const Index node = mesh.topology->markers().nodes_of(other)[0];
    table.entries.push_back({node, {0, 0}, {0, 0}, 7});
    expected =
        "wing.csv:7: node " + std::to_string(node) +
        " lies on \"hole_b\", which does not belong to the chosen markers: choose its marker, too";
  }
  SUBCASE("a node that does not exist") {
    table.entries.push_back({100000, {0, 0}, {0, 0}, 8});
    expected = "wing.csv:8: node 100000 does not exist: the mesh has nodes 0 to ";
  }
  SUBCASE("a negative node") {
    table.entries.push_back({-1, {0, 0}, {0, 0}, 8});
    expected = "wing.csv:8: node -1 does not exist";
  }
  SUBCASE("a position without a node") {
    table.entries.push_back({std::nullopt, {0.25, 0.5}, {0, 0}, 9});
    expected =
        "wing.csv:9: position (0.250000, 0.500000) matches no node of the chosen markers, and none "
        "inside the mesh";
  }
  SUBCASE("a position that is not a number") {
    table.entries.push_back({std::nullopt, {nan_value, 0.5}, {0, 0}, 9});
    expected =
        "wing.csv:9: position (nan, 0.500000) matches no node of the chosen markers, and none "
        "inside the mesh";
  }
  SUBCASE("given twice, by id and by position") {
    table.entries.push_back({std::nullopt, mesh.coordinates.xy(nodes[0]), {0, 0}, 10});
    expected = "is given twice";
  }
  SUBCASE("a displacement that is not finite") {
    table.entries.push_back({nodes[1], {0, 0}, {0, infinity}, 11});
    expected =
        "wing.csv:11: node " + std::to_string(nodes[1]) + " has a displacement that is not finite";
  }
  SUBCASE("unknown file and line") {
    table = {{{nodes[1], {0, 0}, {nan_value, 0}, 0}}, ""};
    expected = "displacements: node " + std::to_string(nodes[1]);
  }
  SUBCASE("no entries") {
    table.entries.clear();
    expected = "the table of displacements is empty";
  }
  SUBCASE("a place without a node, in a table without markers") {
    names = {};
    table.entries.push_back({std::nullopt, {0.3, 0.5}, {0, 0}, 12});
    expected = "wing.csv:12: position (0.300000, 0.500000) matches no node";
  }
  SUBCASE("an unknown marker") {
    names = {"slat"};
    expected = "slat";
  }
  try {
    motion_of(mesh, names, table);
    FAIL("accepted");
  } catch (const UsageError& error) {
    CHECK(std::string(error.what()).find(expected) != std::string::npos);
  }
}

TEST_CASE(
    "nodes inside are prescribed: with markers and without, all others of the boundary stay") {
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    const Mesh mesh = coupled(true, cells);
    const std::vector<Index> solid = solid_of(mesh);
    const DisplacementTable table = bending(mesh);
    for (const Names& markers : {Names{"wet"}, Names{}}) {
      const CommandResult result = executed(markers, table, mesh, all_or_nothing());
      CHECK(result.smooth.converged);
      CHECK(result.smooth.fraction_reached == 1);
      CHECK(result.smooth.inverted == 0);
      CHECK(result.smooth.prescribed_inside == 4);
      const Coordinates& x = result.state.mesh.coordinates;
      double fluid_moves = 0;
      for (Index node = 0; node < x.size(); ++node) {
        const Vec3 before = place_of(mesh.coordinates, node), after = place_of(x, node);
        if (std::ranges::binary_search(solid, node))
          CHECK((after - bent(before)).norm() < 1e-15);
        else if (mesh.topology->on_boundary(node))
          CHECK(after == before);
        else
          fluid_moves = std::max(fluid_moves, (after - before).norm());
      }
      CHECK(fluid_moves > 0.05);
    }
  }
}

TEST_CASE("nodes inside are prescribed by every equation, solver and number of steps") {
  const Mesh mesh = coupled(false);
  const DisplacementTable table = bending(mesh);
  const auto check = [&](const DeformCommand& deform) {
    const CommandResult result = execute(deform, make_state(mesh));
    CHECK(result.smooth.inverted == 0);
    for (const DisplacementEntry& entry : table.entries)
      CHECK((result.state.mesh.coordinates.xy(*entry.node) - mesh.coordinates.xy(*entry.node) -
             entry.displacement.head<2>())
                .norm() < 1e-15);
  };
  DeformCommand deform;
  deform.shape = table;
  for (const int increments : {0, 1, 3}) {
    deform.how.increments = increments;
    deform.smooth = {};
    check(deform);
    deform.smooth.formulation = Formulation::pointwise;
    check(deform);
    deform.smooth.outer = OuterMethod::picard;
    check(deform);
  }
  deform.smooth = {};
  deform.how = {};
  deform.how.smooth_after = false;
  const Coordinates x = execute(deform, make_state(mesh)).state.mesh.coordinates;
  for (Index node = 0; node < x.size(); ++node)
    if (!in_solid(place_of(mesh.coordinates, node), 2))
      CHECK(x.xy(node) == mesh.coordinates.xy(node));
}

TEST_CASE("nodes inside a volume mesh are prescribed") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    const Mesh mesh = make_mesh(cube(10, volumes));
    const DisplacementTable table = bending(mesh);
    REQUIRE(table.entries.size() >= 27);
    const CommandResult result = executed({}, table, mesh, all_or_nothing());
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(result.smooth.inverted == 0);
    CHECK(result.smooth.prescribed_inside == static_cast<Index>(table.entries.size()));
    for (const DisplacementEntry& entry : table.entries)
      CHECK(
          (result.state.mesh.coordinates.xyz(*entry.node) - bent(mesh.coordinates.xyz(*entry.node)))
              .norm() < 1e-15);
  }
}

TEST_CASE("positions are reached to the bit, near the origin and far from it") {
  for (const Vec2& shift : {Vec2(0, 0), Vec2(4.5e5, 5.1e6)}) {
    Mesh mesh = coupled(true);
    for (Index node = 0; node < mesh.coordinates.size(); ++node)
      mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + shift);
    PositionTable table;
    const Mesh near = coupled(true);
    for (const Index node : solid_of(near)) {
      const Vec3 p = place_of(near.coordinates, node);
      table.entries.push_back({node, Vec2(Vec2(bent(p).head<2>()) + shift), 0});
    }
    const CommandResult result = executed({}, table, mesh);
    CHECK(result.smooth.fraction_reached == 1);
    for (const PositionEntry& entry : table.entries)
      CHECK(result.state.mesh.coordinates.xy(entry.node) == Vec2(entry.position.head<2>()));
    CHECK(executed({"wet"}, table, mesh).state.mesh.coordinates == result.state.mesh.coordinates);
  }
}

TEST_CASE("a table of positions is refused with file and line") {
  const Mesh mesh = two_holes();
  const auto complaint = [&](const PositionTable& table, const Names& names = {}) {
    return complaint_of([&] { motion_of(mesh, names, table); });
  };
  CHECK(complaint({{{3, {0.1, 0.1}, 2}, {3, {0.1, 0.1}, 3}}, "p.csv"}) ==
        "p.csv:3: node 3 is given twice");
  CHECK(complaint({{{3, {nan_value, 0.1}, 2}}, "p.csv"}) ==
        "p.csv:2: node 3 has a position that is not finite");
  CHECK(contains(complaint({{{9999, {0, 0}, 2}}, "p.csv"}), "p.csv:2: node 9999 does not exist"));
  CHECK(contains(complaint({{{0, {0, 0}, 2}}, "p.csv"}, {"hole_a"}), "node 0 lies on \"outer\""));
  CHECK(complaint({}) == "the table of positions is empty");
  const Mesh box = make_mesh(cube(2, Volumes::hexahedra));
  CHECK(contains(
      complaint_of([&] {
        motion_of(box, {}, PositionTable{{{3, {0, 0}, 2}}, ""});
      }),
      "positions:2: node 3 has no z: found a table for plane meshes, expected node,x,y,z"));
}

TEST_CASE("a place inside the mesh is found by itself, with markers and without") {
  const Mesh mesh = coupled(true);
  const Names wet{"wet"};
  for (const Index node : solid_of(mesh)) {
    if (mesh.topology->on_boundary(node)) continue;
    // Six digits.
    const Vec2 place = mesh.coordinates.xy(node) + Vec2(4e-7, -3e-7);
    const DisplacementTable table{{{std::nullopt, place, {0.01, 0}, 0}}, ""};
    for (const Names& names : {wet, Names{}}) {
      const auto motion = motion_of(mesh, names, table);
      CHECK(std::ranges::binary_search(motion->nodes(), node));
      CHECK(applied(*motion, mesh.coordinates, 1).xy(node) ==
            Vec2(mesh.coordinates.xy(node) + Vec2(0.01, 0)));
    }
    CHECK(motion_of(mesh, {}, table)->nodes().size() == 1);
  }
  // A place between nodes is none.
  const DisplacementTable between{{{std::nullopt, {0.51, 0.51}, {0, 0}, 4}}, "d.csv"};
  CHECK(complaint_of([&] { motion_of(mesh, {}, between); }) ==
        "d.csv:4: position (0.510000, 0.510000) matches no node");
}

TEST_CASE("prescribed nodes that other options hold, keep or let slide are refused") {
  const Mesh mesh = coupled(true);
  const DisplacementTable table = bending(mesh);
  const auto complaint = [&](const auto& set) {
    DeformCommand deform;
    deform.shape = table;
    set(deform);
    return complaint_of([&] { execute(deform, make_state(mesh)); });
  };
  const std::vector<Index> solid = solid_of(mesh);
  const Index inside =
      *std::ranges::find_if(solid, [&](Index node) { return !mesh.topology->on_boundary(node); });
  CHECK(complaint([&](DeformCommand& deform) { deform.smooth.slide.hold_nodes = {inside}; }) ==
        "node " + std::to_string(inside) + " is to be held, and the motion takes it");
  CHECK(
      contains(complaint([&](DeformCommand& deform) { deform.smooth.keep_outside.radius = 0.05; }),
               "nodes that are to move lie outside the region in which nodes may move"));
  CHECK(complaint([&](DeformCommand& deform) { deform.smooth.keep_outside.radius = 0.4; }) ==
        "accepted");
  CHECK(complaint([&](DeformCommand& deform) { deform.smooth.slide.markers = {"top"}; }) ==
        "accepted");
  CHECK(contains(complaint([&](DeformCommand& deform) {
                   deform.smooth.slide.markers = {"top"};
                   const Names top{"top"};
                   const auto nodes = mesh.topology->markers().nodes_of(top);
                   std::get<DisplacementTable>(deform.shape)
                       .entries.push_back({nodes[nodes.size() / 2], {0, 0}, {0, 0}, 0});
                 }),
                 "marker \"top\" is to slide or to be periodic, and the motion takes its nodes"));
}

TEST_CASE("what moves as a whole inside touches the boundary, marked or not") {
  for (const bool marked : {true, false}) {
    const Mesh mesh = coupled(marked);
    DisplacementTable table;
    for (const Index node : solid_of(mesh)) table.entries.push_back({node, {0, 0}, {0.8, 0}, 0});
    const CommandResult result = executed({}, table, mesh, all_or_nothing());
    CHECK(result.smooth.fraction_reached == 0);
    REQUIRE(result.smooth.contact);
    CHECK(result.smooth.contact->fraction == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(describe_touch(result.smooth.contact->edges) ==
          std::string(marked ? "wet" : "what is prescribed inside") + " would touch right");
    CHECK(result.state.mesh.coordinates == mesh.coordinates);
  }
}

TEST_CASE("prescribed nodes that invert an element are reported before the motion begins") {
  const Mesh mesh = coupled(false);
  // The solid is turned over: its elements are flat at half of the way.
  DisplacementTable table;
  for (const Index node : solid_of(mesh)) {
    const double x = mesh.coordinates.xy(node).x();
    table.entries.push_back({node, {0, 0}, {2 * (0.5 - x), 0}, 0});
  }
  const CommandResult result = executed({}, table, mesh, all_or_nothing());
  CHECK(result.smooth.fraction_reached == 0);
  CHECK_FALSE(result.smooth.converged);
  REQUIRE(result.smooth.held_inversion);
  CHECK(result.smooth.held_inversion->fraction == doctest::Approx(0.5).epsilon(1e-3));
  CHECK(result.smooth.held_inversion->at_end);
  CHECK(result.state.mesh.coordinates == mesh.coordinates);
  const Index element = result.smooth.held_inversion->element;
  for (const Index node : mesh.topology->element(element))
    CHECK(in_solid(place_of(mesh.coordinates, node), 2));
  CHECK(contains(why_incomplete(result.smooth), "the prescribed nodes invert element " +
                                                    std::to_string(element) + " at 50 % of "));
  // In one step the element is inverted at the end.
  DeformCommand direct;
  direct.shape = table;
  direct.how.increments = 1;
  const CommandResult at_once = execute(direct, make_state(mesh), all_or_nothing());
  CHECK(at_once.smooth.inverted > 0);
  CHECK(at_once.smooth.held_inversion);
  direct.how.smooth_after = false;
  const CommandResult alone = execute(direct, make_state(mesh), all_or_nothing());
  CHECK(alone.smooth.inverted > 0);
  CHECK(alone.smooth.held_inversion);
  // As far as it goes.
  const CommandResult partial = executed({}, table, mesh);
  CHECK(partial.smooth.inverted == 0);
  CHECK(partial.smooth.fraction_reached > 0.2);
  CHECK(partial.smooth.fraction_reached < 0.5);
  CHECK(partial.smooth.held_inversion);
}

TEST_CASE("an element that is right again at the end is said to be so, and goes in one step") {
  const Mesh mesh = coupled(false);
  // A half turn by straight ways passes through one point.
  DisplacementTable table;
  for (const Index node : solid_of(mesh)) {
    const Vec2 p = mesh.coordinates.xy(node);
    table.entries.push_back({node, {0, 0}, Vec2(2 * (Vec2(0.5, 0.5) - p)), 0});
  }
  const CommandResult result = executed({}, table, mesh, all_or_nothing());
  REQUIRE(result.smooth.held_inversion);
  CHECK_FALSE(result.smooth.held_inversion->at_end);
  CHECK(contains(describe(*result.smooth.held_inversion), "though not at its end"));
  NodeClasses classes(mesh.topology);
  const auto motion = motion_of(mesh, {}, table);
  classes.set_prescribed(motion->nodes());
  CHECK_FALSE(find_held_inversion(classes, mesh.coordinates, *motion, MotionPart::end));
  CHECK(find_held_inversion(classes, mesh.coordinates, *motion, MotionPart::way));
}

TEST_CASE("layers whose heights are held are not prescribed as well") {
  const Mesh mesh = make_mesh(square_with_hole(10, Cells::triangles));
  LayersCommand layers;
  layers.layers.walls = {{{"hole"}, {.count = 3, .first = 0.005, .ratio = 1.2}}};
  const MeshState state = execute(layers, make_state(mesh)).state;
  REQUIRE(state.layers);
  DeformCommand deform;
  const Index node = state.layers->columns.front().nodes[1];
  deform.shape = DisplacementTable{{{node, {0, 0}, {1e-4, 0}, 0}}, ""};
  CHECK(complaint_of([&] { execute(deform, state); }) ==
        "node " + std::to_string(node) +
            " is prescribed and belongs to layers whose heights are to be held: expected one of "
            "the two");
}
