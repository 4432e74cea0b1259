#include "io/tables/motion_table.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "io/support/files.h"

namespace winslow::test {
namespace {

std::vector<io::MotionStep> motions_in(const std::string& text, const MovingBody& otherwise = {}) {
  const TemporaryFolder folder;
  write_text(folder / "motions.csv", text);
  return io::read_motions(folder / "motions.csv", otherwise);
}

}  // namespace

TEST_CASE("rows of one step move together, each by its own motion") {
  const auto steps = motions_in(
      "step,marker,rotate,pivot_x,pivot_y,translate_x,translate_y\n"
      "a,slat,5,,,0.1,-0.2  # first\n"
      "b,flap,-3,1,2,,\n"
      "a,\"flap, tab\",-20,0.8,0,,\n");
  REQUIRE(steps.size() == 2);
  CHECK(steps[0].name == "a");
  CHECK(steps[0].line == 2);
  REQUIRE(steps[0].bodies.size() == 2);
  CHECK(steps[0].bodies[0] ==
        MovingBody{{"slat"}, {.rotate = 5, .translate = GivenVector(0.1, -0.2)}});
  CHECK_FALSE(steps[0].bodies[0].motion.translate.leaves_plane());
  CHECK(steps[0].bodies[1] ==
        MovingBody{{"flap", "tab"}, {.rotate = -20, .pivot = GivenVector(0.8, 0)}});
  CHECK(steps[1].name == "b");
  CHECK(steps[1].bodies[0].motion.pivot == GivenVector(1, 2));
}

TEST_CASE("columns may be in any order, of space, and separated by other characters") {
  for (const std::string& separator : {std::string(";"), std::string("\t"), std::string("  ")}) {
    std::string text = "Translate_Z,marker,axis_z,axis_x,axis_y,rotate\n0.5,wing,1,0,0,12\n";
    for (std::size_t at = 0; (at = text.find(',', at)) != std::string::npos;)
      text.replace(at, 1, separator);
    const auto steps = motions_in(text);
    REQUIRE(steps.size() == 1);
    CHECK(steps[0].name == "1");
    const RigidMotion& motion = steps[0].bodies[0].motion;
    CHECK(motion.axis == Vec3(0, 0, 1));
    CHECK(motion.translate == Vec3(0, 0, 0.5));
    CHECK(motion.translate.leaves_plane());
    CHECK(motion.rotate == 12);
  }
}

TEST_CASE("what a table leaves out is what the caller says") {
  const MovingBody otherwise{{"flap"}, {.rotate = 7, .pivot = GivenVector(1, 0)}};
  const auto steps = motions_in("translate_x\n0.5\n1\n", otherwise);
  REQUIRE(steps.size() == 2);
  CHECK(steps[1].name == "2");
  CHECK(steps[1].bodies[0] ==
        MovingBody{{"flap"},
                   {.rotate = 7, .pivot = GivenVector(1, 0), .translate = GivenVector(1, 0)}});
}

TEST_CASE("errors of a table name the file, the line, what was found and what was expected") {
  struct Case {
    const char *text, *message;
  };
  for (const Case& wrong :
       {Case{"marker,rotat\nflap,3\n", ":1: found the column 'rotat', expected names"},
        Case{"marker,rotate\nflap,3,4\n", ":2: found 3 columns, expected 2"},
        Case{"marker,rotate\nflap,nan\n", ":2: found 'nan' in the column rotate, expected a fin"},
        Case{"step,marker,rotate\n1,flap,3\n\n1,flap,4\n",
             ":4: found the marker 'flap' twice in step 1"},
        Case{"marker,rotate,axis_x,axis_y\nflap,3,0,0\n", ":1: found some of the columns axis"},
        Case{"marker,rotate\n", "found no row"}, Case{"# nothing\n", "found no line of names"}})
    CHECK_THROWS_WITH_AS(motions_in(wrong.text), doctest::Contains(wrong.message), InputError);
}

}  // namespace winslow::test
