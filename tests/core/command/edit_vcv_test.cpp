#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/command/command.h"
#include "core/command/history.h"
#include "core/error.h"
#include "core/formulation/target_shapes.h"
#include "core/inspect/nodal_view.h"
#include "core/quality/quality.h"
#include "core/strategy/workspace.h"
#include "core/vcv/sphere/node_vcv.h"
#include "support/samples.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A node well inside with six neighbours.
Index inner_node(const Topology& topology) {
  for (const Index node : topology.interior_nodes()) {
    const auto ring = topology.neighbours(node);
    if (ring.size() == 6 &&
        std::none_of(ring.begin(), ring.end(), [&](Index k) { return topology.on_boundary(k); })) {
      return node;
    }
  }
  FAIL("no such node");
  return -1;
}

MeshState smoothed(const MeshState& state, const SmoothOptions& options = {}) {
  return execute(SmoothCommand{options}, state).state;
}

MeshState triangles() { return smoothed(make_state(make_mesh(square(8, Cells::triangles)))); }

/// One wide angle, between neighbours 0 and 1.
VcvEdit wide_angle(const Topology& topology, Index node) {
  const auto ring = topology.neighbours(node);
  return {node, {ring.begin(), ring.end()}, {90, 54, 54, 54, 54, 54}, {}};
}

/// Angle between edges k and k + 1 in the mesh, degrees.
double angle_at(const MeshState& state, Index node, std::size_t k) {
  return degrees(
      inspect_node(*state.vcvs.plane(), state.mesh.coordinates, node).physical.angles[k]);
}

}  // namespace

TEST_CASE("a wider angle of a VCV opens the angle of the mesh, in either formulation") {
  const MeshState before = triangles();
  const Topology& topology = *before.mesh.topology;
  const Index node = inner_node(topology);
  for (const Formulation formulation : {Formulation::variational, Formulation::pointwise}) {
    CAPTURE(formulation_name(formulation));
    SmoothOptions options;
    options.formulation = formulation;
    const MeshState start = smoothed(before, options);
    const CommandResult result =
        execute(EditVcvCommand{{wide_angle(topology, node)}, options}, start);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.inverted == 0);
    CHECK(angle_at(result.state, node, 0) > angle_at(start, node, 0) + 5);
    CHECK(result.state.vcvs.plane()->edited(node));
    CHECK(result.state.vcvs.plane()->edits().size() == 1);
    CHECK_FALSE(start.vcvs.plane()->edited(node));
    // The edit stays: smoothing again changes nothing.
    const CommandResult again = execute(SmoothCommand{options}, result.state);
    CHECK(std::abs(angle_at(again.state, node, 0) - angle_at(result.state, node, 0)) < 1e-6);
    // Resetting it brings the mesh back.
    const CommandResult reset =
        execute(EditVcvCommand{{{node, {}, {}, {}}}, options}, result.state);
    CHECK_FALSE(reset.state.vcvs.plane()->edited(node));
    for (Index i = 0; i < topology.node_count(); ++i) {
      CHECK((reset.state.mesh.coordinates.xy(i) - start.mesh.coordinates.xy(i)).norm() < 1e-7);
    }
  }
}

TEST_CASE("solvers kept from edit to edit give the mesh that new ones give, and keep the pattern") {
  const MeshState start = triangles();
  const Topology& topology = *start.mesh.topology;
  const Index node = inner_node(topology);
  for (const Formulation formulation : {Formulation::variational, Formulation::pointwise}) {
    CAPTURE(formulation_name(formulation));
    EditVcvCommand command{{wide_angle(topology, node)}, {}};
    command.smooth.formulation = formulation;
    SolverCache cache;
    RunOptions kept;
    kept.cache = &cache;
    execute(SmoothCommand{command.smooth}, start, kept);
    const auto pattern_now = [&] {
      SparseMatrix matrix;
      std::vector<double> residual(2 * topology.interior_nodes().size());
      cache.workspace().energy()->linearise(start.mesh.coordinates, Curvature::exact, matrix,
                                            residual);
      return matrix.pattern;
    };
    const auto pattern = pattern_now();
    for (const double angle : {90.0, 110.0, 75.0}) {
      auto& angles = command.edits.front().angles;
      std::fill(angles.begin(), angles.end(), (360 - angle) / 5);
      angles.front() = angle;
      const CommandResult warm = execute(command, start, kept);
      CHECK(warm.state.mesh.coordinates == execute(command, start).state.mesh.coordinates);
      CHECK(pattern_now() == pattern);
    }
  }
}

TEST_CASE("a longer edge of a VCV moves the node away from that neighbour") {
  const MeshState before = triangles();
  const Index node = inner_node(*before.mesh.topology);
  const VcvEdit edit{node, {}, {}, {2, 1, 1, 1, 1, 1}};
  const CommandResult result = execute(EditVcvCommand{{edit}, {}}, before);
  const auto share = [&](const MeshState& state) {
    const NodalView view = inspect_node(*state.vcvs.plane(), state.mesh.coordinates, node);
    return view.physical.lengths[0] / view.physical.mean_length();
  };
  CHECK(result.smooth.inverted == 0);
  CHECK(share(result.state) > 1.1 * share(before));
}

TEST_CASE("quadrilaterals answer to edited VCVs, too") {
  const MeshState before = smoothed(make_state(make_mesh(square(8, Cells::quads))));
  const Index node = before.mesh.topology->interior_nodes()[24];
  REQUIRE(before.mesh.topology->neighbours(node).size() == 4);
  const CommandResult result =
      execute(EditVcvCommand{{{node, {}, {120, 80, 80, 80}, {}}}, {}}, before);
  CHECK(result.smooth.inverted == 0);
  CHECK(angle_at(result.state, node, 0) > angle_at(before, node, 0) + 5);
}

TEST_CASE("numbers belong to the neighbours named, from whichever the list starts") {
  const MeshState before = triangles();
  const Topology& topology = *before.mesh.topology;
  const Index node = inner_node(topology);
  const VcvEdit plain{node, {}, {90, 40, 50, 60, 70, 50}, {1, 2, 3, 4, 5, 6}};
  const auto ring = topology.neighbours(node);
  for (std::size_t first = 0; first < 6; ++first) {
    VcvEdit turned{node, {}, {}, {}};
    for (std::size_t k = 0; k < 6; ++k) {
      turned.neighbours.push_back(ring[(first + k) % 6]);
      turned.angles.push_back(plain.angles[(first + k) % 6]);
      turned.lengths.push_back(plain.lengths[(first + k) % 6]);
    }
    const auto vcv = edit_vcvs(*before.vcvs.plane(), std::vector{turned});
    for (std::size_t k = 0; k < 6; ++k) {
      CHECK(vcv->angles(node)[k] == doctest::Approx(radians(plain.angles[k])));
      CHECK(vcv->lengths(node)[k] == plain.lengths[k]);
    }
    const VcvEdit back = edit_of(*vcv, node);
    CHECK(back.angles[0] == doctest::Approx(90));
    CHECK(back.lengths == plain.lengths);
  }
  CHECK(edit_of(*before.vcvs.plane(), node).resets());
}

TEST_CASE("edits that are no VCV are refused, with the node named") {
  const MeshState state = triangles();
  const Topology& topology = *state.mesh.topology;
  const Index node = inner_node(topology);
  const auto ring = topology.neighbours(node);
  VcvEdit edit{node, {ring.begin(), ring.end()}, {90, 54, 54, 54, 54, 54}, {}};
  std::string expected;
  SUBCASE("a sum") {
    edit.angles[1] = 60;
    expected = "do not sum to 360";
  }
  SUBCASE("a number of angles") {
    edit.angles = {120, 120, 120};
    expected = "expected 6 angles";
  }
  SUBCASE("a reflex angle") {
    edit.angles = {200, 32, 32, 32, 32, 32};
    expected = "outside (0, pi)";
  }
  SUBCASE("a length") {
    edit.lengths = {1, 1, 0, 1, 1, 1};
    expected = "not positive";
  }
  SUBCASE("lengths that arithmetic cannot tell apart") {
    edit.lengths = {1, 1, 2e12, 1, 1, 1};
    expected = "1e12 times the shortest";
  }
  SUBCASE("a stranger among the neighbours") {
    edit.neighbours[2] = node;
    expected = "the neighbours are not those of the mesh, which are";
  }
  SUBCASE("a node on the boundary") {
    edit.node = topology.boundary_loops()[0][0];
    expected = "not a free node";
  }
  SUBCASE("a node that does not exist") {
    edit.node = topology.node_count();
    expected = "not a free node";
  }
  CAPTURE(expected);
  try {
    execute(EditVcvCommand{{edit}, {}}, state);
    FAIL("accepted");
  } catch (const UsageError& error) {
    const std::string text = error.what();
    CHECK(text.find(expected) != std::string::npos);
    CHECK(text.find(std::to_string(edit.node)) != std::string::npos);
  }
  CHECK_THROWS_AS(execute(EditVcvCommand{}, state), UsageError);
}

TEST_CASE("undo of an edit gives back mesh and VCVs, to the bit; its description names it") {
  const MeshState before = triangles();
  const Index node = inner_node(*before.mesh.topology);
  History history(before);
  const EditVcvCommand command{{wide_angle(*before.mesh.topology, node)}, {}};
  history.push(command, execute(command, before));
  CHECK(history.state().vcvs.plane()->edited(node));
  history.undo();
  CHECK(history.state().mesh.coordinates == before.mesh.coordinates);
  CHECK(history.state().vcvs.plane() == before.vcvs.plane());
  CHECK(describe(command) == "Edit the VCV of node " + std::to_string(node));
  CHECK(describe(EditVcvCommand{{{3, {}, {}, {}}, {4, {}, {}, {}}}, {}}) ==
        "Reset the VCVs of 2 nodes");
  CHECK(command_name(command) == "edit_vcv");
}

TEST_CASE("an edited VCV counts although the blend has no share for VCVs, only around its node") {
  const MeshState before = triangles();
  const Topology& topology = *before.mesh.topology;
  const Index node = inner_node(topology);
  const auto vcv = edit_vcvs(*before.vcvs.plane(), std::vector{wide_angle(topology, node)});
  const TargetShapes plain =
      TargetShapes::build(*before.vcvs.plane(), TargetBlend::regular(), nullptr);
  const TargetShapes edited = TargetShapes::build(*vcv, TargetBlend::regular(), nullptr);
  const TargetShapes of_vcv = TargetShapes::build(*vcv, {0, 0, 1, 0}, nullptr);
  REQUIRE(plain.cells == edited.cells);
  std::size_t changed = 0;
  for (std::size_t t = 0; t < plain.cells.size(); ++t) {
    const auto& nodes = plain.cells[t];
    const bool around = std::find(nodes.begin(), nodes.end(), node) != nodes.end();
    const auto first = static_cast<std::size_t>(edited.offsets[t]);
    REQUIRE(edited.offsets[t + 1] - edited.offsets[t] == 1);
    const ShapeTerm& a = plain.terms[first];
    const ShapeTerm& b = edited.terms[first];
    CHECK(b.weight == 1);
    const bool same = a.ab == b.ab && a.ac == b.ac && a.bc == b.bc;
    if (!around) CHECK(same);
    changed += same ? 0 : 1;
    if (!around) continue;
    // The term is one of those that the VCVs alone give.
    bool found = false;
    for (Index k = of_vcv.offsets[t]; k < of_vcv.offsets[t + 1]; ++k) {
      const ShapeTerm& c = of_vcv.terms[at(k)];
      found =
          found || (std::abs(c.ab - b.ab) + std::abs(c.ac - b.ac) + std::abs(c.bc - b.bc)) < 1e-12;
    }
    CHECK(found);
  }
  CHECK(changed == 6);
}

TEST_CASE("stars are matched by the directions of their edges") {
  const std::vector<Vec2> from = regular_polygon(6);
  for (std::size_t shift = 0; shift < 6; ++shift) {
    std::vector<Vec2> to;
    for (std::size_t k = 0; k < 6; ++k) {
      const double phi = 2 * pi * static_cast<double>(k + 6 - shift) / 6 + 0.2;
      to.push_back(3 * Vec2(std::cos(phi), std::sin(phi)));
    }
    CHECK(matching_shift(from, to) == shift);
  }
}

namespace {

SmoothOptions by(Formulation formulation) {
  SmoothOptions options;
  options.formulation = formulation;
  return options;
}

/// The star of a node, seen from another place than the node's: what its VCV has to be for the
/// node to go there, since the operator is exact for linear maps, and the distortion of every
/// tetrahedron 1.
VcvEdit star_from(const Mesh& mesh, Index node, const Vec3& place) {
  VcvEdit edit{node, {}, {}, {}};
  for (const Index k : mesh.topology->neighbours(node)) {
    edit.neighbours.push_back(k);
    edit.directions.emplace_back(mesh.coordinates.xyz(k) - place);
    edit.lengths.push_back(edit.directions.back().norm());
  }
  return edit;
}

double furthest(const Mesh& a, const Mesh& b) {
  double most = 0;
  for (Index i = 0; i < a.coordinates.size(); ++i)
    most = std::max(most, (a.coordinates.xyz(i) - b.coordinates.xyz(i)).norm());
  return most;
}

}  // namespace

TEST_CASE("a node goes to where its star looks like the VCV that it was given, in either form") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    CAPTURE(name_of(volumes));
    const MeshState start = make_state(make_mesh(cube(2, volumes)));
    const Index node = start.mesh.topology->interior_nodes().front();
    const Vec3 place(0.6, 0.45, 0.55);
    for (const Formulation formulation : {Formulation::variational, Formulation::pointwise}) {
      CAPTURE(formulation_name(formulation));
      const EditVcvCommand command{{star_from(start.mesh, node, place)}, by(formulation)};
      const CommandResult result = execute(command, start);
      CHECK(result.smooth.converged);
      REQUIRE(result.state.vcvs.by_hand());
      CHECK(start.vcvs.by_hand() == nullptr);
      // A hexahedron has other corners, which have a say in the energy.
      const bool alone = volumes == Volumes::tetrahedra || formulation == Formulation::pointwise;
      const Vec3 reached = result.state.mesh.coordinates.xyz(node);
      if (alone) CHECK((reached - place).norm() < 1e-7);
      CHECK((reached - place).norm() < (start.mesh.coordinates.xyz(node) - place).norm() / 2);
      // It stays: smoothing again changes nothing.
      const CommandResult again = execute(SmoothCommand{by(formulation)}, result.state);
      // The targets of a hexahedron's other corners are made of the mesh as given.
      if (alone) CHECK(furthest(again.state.mesh, result.state.mesh) < 1e-7);
      CHECK(again.state.vcvs.by_hand() == result.state.vcvs.by_hand());
      // Reset, it goes back to the middle.
      const CommandResult reset =
          execute(EditVcvCommand{{{node, {}, {}, {}}}, by(formulation)}, result.state);
      CHECK(reset.state.vcvs.by_hand() == nullptr);
      SmoothCommand tight{by(formulation)};
      tight.smooth.tolerance = 1e-10;  // that of edits
      const CommandResult plain = execute(tight, make_state(result.state.mesh));
      CHECK(furthest(reset.state.mesh, plain.state.mesh) < 1e-7);
    }
  }
}

TEST_CASE("VCVs of all nodes by hand lead to the mesh whose stars they are") {
  const Mesh wanted = shaken_box(4, 0.2, 21);
  EditVcvCommand command;
  for (const Index node : wanted.topology->interior_nodes())
    command.edits.push_back(star_from(wanted, node, wanted.coordinates.xyz(node)));
  const MeshState start =
      make_state({wanted.topology, make_mesh(cube(4, Volumes::tetrahedra)).coordinates});
  REQUIRE(furthest(start.mesh, wanted) > 0.02);
  for (const Formulation formulation : {Formulation::variational, Formulation::pointwise}) {
    CAPTURE(formulation_name(formulation));
    command.smooth = by(formulation);
    const CommandResult result = execute(command, start);
    CHECK(result.smooth.converged);
    CHECK(furthest(result.state.mesh, wanted) < 1e-6);
  }
}

TEST_CASE("a solver that is kept takes edited VCVs as a fresh one does") {
  const MeshState start = make_state(shaken_box(4, 0.2, 22));
  const auto interior = start.mesh.topology->interior_nodes();
  for (const Formulation formulation : {Formulation::variational, Formulation::pointwise}) {
    CAPTURE(formulation_name(formulation));
    SmoothOptions options = by(formulation);
    options.targets = {.automatic = 0.5, .vcv = 0.5};
    SolverCache kept;
    RunOptions run;
    run.cache = &kept;
    for (const double off : {0.0, 0.02, 0.04, 0.0}) {
      EditVcvCommand command{{}, options};
      for (const Index node : {interior[3], interior[8]})
        command.edits.push_back(
            star_from(start.mesh, node, start.mesh.coordinates.xyz(node) + Vec3(off, 0, -off)));
      if (off == 0.04) command.edits.pop_back();  // one of them has its own again
      const CommandResult warm = execute(command, start, run);
      const CommandResult cold = execute(command, start);
      CHECK(warm.smooth.converged);
      CHECK(furthest(warm.state.mesh, cold.state.mesh) < 1e-12);
    }
  }
}

TEST_CASE("edited VCVs of a volume mesh stay through motions; what is no VCV is refused") {
  const MeshState start = make_state(make_mesh(cube_with_cavity(6, Volumes::tetrahedra)));
  const Index node = start.mesh.topology->interior_nodes().front();
  const Vec3 place = start.mesh.coordinates.xyz(node) + Vec3(0.02, 0.01, 0);
  const EditVcvCommand edit{{star_from(start.mesh, node, place)}, {}};
  History history(start);
  history.push(edit, execute(edit, history.state()));
  MoveCommand move;
  move.bodies[0].markers = {"cavity"};
  move.bodies[0].motion.translate = Vec2(0.02, 0);
  history.push(move, execute(move, history.state()));
  REQUIRE(history.state().vcvs.by_hand());
  CHECK(history.state().vcvs.by_hand()->contains(node));
  history.undo();
  history.undo();
  CHECK(history.state().vcvs.by_hand() == nullptr);
  CHECK_THROWS_AS(execute(EditVcvCommand{{{node, {}, {}, {1, 1}}}, {}}, start), UsageError);
  CHECK_THROWS_AS(execute(EditVcvCommand{{{0, {}, {}, {}}}, {}}, start), UsageError);
  CHECK_THROWS_AS(execute(EditVcvCommand{}, start), UsageError);
}

TEST_CASE("far from the origin edited VCVs do what they do near it") {
  const MeshState near = make_state(shaken_box(3, 0.2, 23));
  const Vec3 away(4.5e5, 5.1e6, 300);
  MeshState far = near;
  for (Index i = 0; i < far.mesh.coordinates.size(); ++i)
    far.mesh.coordinates.set_xyz(i, near.mesh.coordinates.xyz(i) + away);
  const Index node = near.mesh.topology->interior_nodes().front();
  const EditVcvCommand edit{
      {star_from(near.mesh, node, near.mesh.coordinates.xyz(node) + Vec3(0.05, 0, 0.05))}, {}};
  const CommandResult a = execute(edit, near), b = execute(edit, far);
  REQUIRE(b.state.vcvs.by_hand());
  CHECK(*a.state.vcvs.by_hand() == *b.state.vcvs.by_hand());
  for (Index i = 0; i < near.mesh.coordinates.size(); ++i)
    CHECK((b.state.mesh.coordinates.xyz(i) - away - a.state.mesh.coordinates.xyz(i)).norm() < 1e-6);
}
