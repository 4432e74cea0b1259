#include "elasticity/elasticity_case.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "core/motion/motion.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::bench;
using namespace winslow::test;

namespace {

ElasticityCase read(const std::vector<std::string>& words) { return read_case(words, "usage"); }

/// The nodes of the body are where the motion takes them, the others of the boundary stay.
void check_moved(const ElasticityCase& wanted, const Mesh& before) {
  Mesh after = before;
  const ElasticityResult result = move_elastically(wanted, after);
  CHECK(result.fault.empty());
  Coordinates expected = before.coordinates;
  make_motion(*before.topology, before.coordinates, wanted.markers, for_mesh(wanted, before))
      ->apply(before.coordinates, 1, expected);
  Index moved_inside = 0;
  for (Index node = 0; node < before.coordinates.size(); ++node) {
    const Vec3 there = place_of(after.coordinates, node);
    if (before.topology->on_boundary(node)) {
      CHECK((there - place_of(expected, node)).norm() < 1e-12);
    } else if ((there - place_of(before.coordinates, node)).norm() > 1e-4) {
      ++moved_inside;
    }
  }
  CHECK(moved_inside > 0);
}

}  // namespace

TEST_CASE("the options of elastic_move are those of winslow move") {
  const auto wanted = read({"a.su2",     "--marker", "slat",         "--marker",
                            "flap",      "--rotate", "-40",          "--pivot",
                            "0.5",       "-0.1",     "--translate",  "1",
                            "2",         "3",        "--axis",       "0",
                            "1",         "1",        "--increments", "7",
                            "--modulus", "distance", "--tolerance",  "1e-4",
                            "-o",        "b.su2"});
  CHECK(wanted.mesh == "a.su2");
  CHECK(wanted.markers == std::vector<std::string>{"slat", "flap"});
  CHECK(wanted.motion == RigidMotion{.rotate = -40,
                                     .pivot = Vec2(0.5, -0.1),
                                     .translate = Vec3(1, 2, 3),
                                     .axis = Vec3(0, 1, 1)});
  CHECK(wanted.elasticity.increments == 7);
  CHECK(wanted.elasticity.modulus == Modulus::wall_distance);
  CHECK(wanted.elasticity.tolerance == 1e-4);
  CHECK(wanted.output == "b.su2");
}

TEST_CASE("wrong options of elastic_move are refused") {
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{},
                                             {"a.su2"},
                                             {"--marker", "body"},
                                             {"a.su2", "--marker"},
                                             {"a.su2", "--marker", "body", "--rotate", "far"},
                                             {"a.su2", "--marker", "body", "--increments", "0"},
                                             {"a.su2", "--marker", "body", "--increments", "1.5"},
                                             {"a.su2", "--marker", "body", "--translate", "1"},
                                             {"a.su2", "--marker", "body", "--axis", "0", "1"},
                                             {"a.su2", "--marker", "body", "--modulus", "soft"},
                                             {"a.su2", "--marker", "body", "--rotat", "3"}}) {
    CAPTURE(wrong.size());
    CHECK_THROWS_AS(read(wrong), UsageError);
  }
}

TEST_CASE("elastic meshes end with their bodies where the motion takes them") {
  check_moved(read({"mesh.su2", "--marker", "hole", "--rotate", "10", "--pivot", "0.5", "0.5",
                    "--translate", "0.02", "0", "--increments", "3"}),
              make_mesh(square_with_hole(12, Cells::mixed)));
  check_moved(read({"mesh.su2", "--marker", "cavity", "--rotate", "10", "--pivot", "0.5", "0.5",
                    "0.5", "--translate", "0.02", "0", "0.01", "--increments", "2"}),
              make_mesh(cube_with_cavity(6, Volumes::tetrahedra)));
}

TEST_CASE("motions that do not fit the mesh are refused") {
  Mesh plane = make_mesh(square_with_hole(12, Cells::triangles));
  CHECK_THROWS_AS(move_elastically(read({"mesh.su2", "--marker", "no such marker"}), plane),
                  UsageError);
  CHECK_THROWS_AS(
      move_elastically(read({"mesh.su2", "--marker", "hole", "--translate", "0", "0", "1"}), plane),
      UsageError);
}
