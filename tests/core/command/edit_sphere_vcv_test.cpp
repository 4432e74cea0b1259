#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/command/history.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "core/strategy/workspace.h"
#include "core/vcv/sphere/sphere_edit.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

SmoothOptions by(const std::string& formulation) {
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
    for (const char* formulation : {"variational", "pointwise"}) {
      CAPTURE(formulation);
      const EditVcvCommand command{{star_from(start.mesh, node, place)}, by(formulation)};
      const CommandResult result = execute(command, start);
      CHECK(result.smooth.converged);
      REQUIRE(result.state.sphere_vcvs);
      CHECK(start.sphere_vcvs == nullptr);
      // A hexahedron has other corners, which have a say in the energy.
      const bool alone = volumes == Volumes::tetrahedra || formulation == std::string("pointwise");
      const Vec3 reached = result.state.mesh.coordinates.xyz(node);
      if (alone) CHECK((reached - place).norm() < 1e-7);
      CHECK((reached - place).norm() < (start.mesh.coordinates.xyz(node) - place).norm() / 2);
      // It stays: smoothing again changes nothing.
      const CommandResult again = execute(SmoothCommand{by(formulation)}, result.state);
      // The targets of a hexahedron's other corners are made of the mesh as given.
      if (alone) CHECK(furthest(again.state.mesh, result.state.mesh) < 1e-7);
      CHECK(again.state.sphere_vcvs == result.state.sphere_vcvs);
      // Reset, it goes back to the middle.
      const CommandResult reset =
          execute(EditVcvCommand{{{node, {}, {}, {}}}, by(formulation)}, result.state);
      CHECK(reset.state.sphere_vcvs == nullptr);
      const CommandResult plain =
          execute(SmoothCommand{by(formulation)}, make_state(result.state.mesh));
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
  for (const char* formulation : {"variational", "pointwise"}) {
    CAPTURE(formulation);
    command.smooth = by(formulation);
    const CommandResult result = execute(command, start);
    CHECK(result.smooth.converged);
    CHECK(furthest(result.state.mesh, wanted) < 1e-6);
  }
}

TEST_CASE("a solver that is kept takes edited VCVs as a fresh one does") {
  const MeshState start = make_state(shaken_box(4, 0.2, 22));
  const auto interior = start.mesh.topology->interior_nodes();
  for (const char* formulation : {"variational", "pointwise"}) {
    CAPTURE(formulation);
    SmoothOptions options = by(formulation);
    options.targets = {.automatic = 0.5, .vcv = 0.5};
    SmoothingWorkspace kept;
    RunOptions run;
    run.workspace = &kept;
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
  move.markers = {"cavity"};
  move.motion.translate = Vec2(0.02, 0);
  history.push(move, execute(move, history.state()));
  REQUIRE(history.state().sphere_vcvs);
  CHECK(history.state().sphere_vcvs->contains(node));
  history.undo();
  history.undo();
  CHECK(history.state().sphere_vcvs == nullptr);
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
  REQUIRE(b.state.sphere_vcvs);
  CHECK(*a.state.sphere_vcvs == *b.state.sphere_vcvs);
  for (Index i = 0; i < near.mesh.coordinates.size(); ++i)
    CHECK((b.state.mesh.coordinates.xyz(i) - away - a.state.mesh.coordinates.xyz(i)).norm() < 1e-6);
}
