#include "core/strategy/face_angles.h"

#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/openfoam_measures.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

constexpr double limit = 70;

MoveCommand turn_body(double degrees) {
  MoveCommand move;
  move.bodies[0].markers = {"body"};
  move.bodies[0].motion.rotate = degrees;
  move.bodies[0].motion.axis = Vec3(0, 0, 1);
  return move;
}

/// The mesh of a motion without what keeps angles.
Coordinates solution_of(const MoveCommand& move, const MeshState& state) {
  MoveCommand limited = move;
  limited.how.floor.set(Metric::face_pyramid, -1e9);  // no limit, but one that is asked for
  return execute(limited, state).state.mesh.coordinates;
}

std::vector<Index> leaning(const Topology& topology, const Coordinates& x) {
  const CellFaces faces = cell_faces(topology);
  const FiniteVolumes all(faces, x);
  std::vector<Index> list;
  for (Index f = 0; f < faces.face_count(); ++f)
    if (faces.internal(f) && degrees(std::acos(all.orthogonality(f))) > limit) list.push_back(f);
  return list;
}

}  // namespace

TEST_CASE("faces that a motion makes lean are brought back") {
  const Mesh mesh = make_mesh(split_box_with_body(6));
  const MeshState state = make_state(mesh);
  REQUIRE(leaning(*mesh.topology, mesh.coordinates).empty());
  const MoveCommand move = turn_body(120);
  const Coordinates solution = solution_of(move, state);
  const std::size_t before = leaning(*mesh.topology, solution).size();
  REQUIRE(before > 0);
  const CommandResult result = execute(move, state);
  const Coordinates& x = result.state.mesh.coordinates;
  REQUIRE(result.smooth.face_angles);
  const auto after = static_cast<Index>(leaning(*mesh.topology, x).size());
  CHECK(result.smooth.face_angles->beyond == after);
  CHECK(result.smooth.face_angles->mended == static_cast<Index>(before) - after);
  CHECK(after == 0);
  CHECK(check_validity(*mesh.topology, x).inverted == 0);
  CHECK(openfoam_measures({mesh.topology, x}).failures().empty());
  const Damage damage = find_damage(mesh, {mesh.topology, solution});
  CHECK(damage.leaning_faces == static_cast<Index>(before));
  CHECK(damage.text.find("by more than 70 degrees (non-orthogonality), at worst by 7") !=
        std::string::npos);
  CHECK(find_damage(mesh, {mesh.topology, x}).leaning_faces == 0);
  // Only nodes near these faces have moved from the solution.
  Index moved = 0;
  for (Index i = 0; i < x.size(); ++i)
    if (x.xyz(i) != solution.xyz(i)) ++moved;
  CHECK(moved > 0);
  CHECK(moved < x.size() / 2);
}

TEST_CASE("angles of faces: a small motion and the way back leave the solution alone") {
  const Mesh mesh = make_mesh(split_box_with_body(6));
  const MeshState state = make_state(mesh);
  const CommandResult small = execute(turn_body(5), state);
  REQUIRE(small.smooth.face_angles);
  CHECK(small.smooth.face_angles->beyond == 0);
  CHECK(small.smooth.face_angles->mended == 0);
  CHECK(small.state.mesh.coordinates == solution_of(turn_body(5), state));
  const CommandResult there = execute(turn_body(120), state);
  CHECK(there.smooth.face_angles->mended > 0);
  MeshState at_end = there.state;
  const CommandResult back = execute(turn_body(-120), at_end);
  double apart = 0;
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    apart = std::max(apart, (back.state.mesh.coordinates.xyz(i) - mesh.coordinates.xyz(i)).norm());
  CHECK(apart < 1e-6);
}

TEST_CASE("angles of faces are not heeded in meshes of elements by their types") {
  const Mesh mesh = box_with_body(4, Volumes::hexahedra);
  CHECK_FALSE(execute(turn_body(5), make_state(mesh)).smooth.face_angles);
}

TEST_CASE("a cancelled run throws while angles of faces are kept") {
  struct Cancelling : SolverMonitor {
    bool on_iteration(const IterationRecord&, const Coordinates&) override { return true; }
    bool cancelled() override { return true; }
  } monitor;
  const Mesh mesh = make_mesh(split_box_with_body(6));
  const MeshState state = make_state(mesh);
  Coordinates x = solution_of(turn_body(120), state);
  NodeClasses classes(mesh.topology);
  CHECK_THROWS_AS(keep_face_angles(state, classes, MoveCommand{}.smooth, nullptr, &monitor, x),
                  Cancelled);
}
