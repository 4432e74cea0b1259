#include "io/format/mesh_format.h"
#include "io/support/samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

const std::string square = "NDIME= 2\n% zone\nNELEM= 1\n9 0 1 2 3\nNPOIN= 4\n";
const std::string markers = "NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n3 0 1\n";
const std::string near = square + "0 0\n1 0\n1 1\n0 1\n" + markers;
const std::string far = square + "5 0\n6 0\n6 1\n5 1\n" + markers + "FFD_NBOX= 0\n";
const std::string both = "NZONE= 2\nIZONE= 1 % first\n" + near + "\nIZONE= 7\n" + far;

io::MeshFile read(const TemporaryFolder& folder, const std::string& text, int zone) {
  write_text(folder / "a.su2", text);
  return io::read_mesh(folder / "a.su2", {.zone = zone});
}

}  // namespace

TEST_CASE("SU2 zones: one is read, the first one unless another is asked for") {
  const TemporaryFolder folder;
  const io::MeshFile first = read(folder, both, 0);
  CHECK(first.mesh.coordinates.xy(2) == Vec2(1, 1));
  CHECK(first.details->zones == std::vector<int>{1, 7});
  CHECK(first.details->zone == 1);
  CHECK(any_contains(io::zones_left(first.details.get(), "a.su2"),
                     "a.su2: has 2 zones (1, 7); this is zone 1, --zone N opens another"));
  const io::MeshFile second = read(folder, both, 7);
  CHECK(second.mesh.coordinates.xy(2) == Vec2(6, 1));
  CHECK(second.details->zone == 7);
  CHECK(second.mesh.topology->markers()[0].name == "wall");
  CHECK(any_contains(second.warnings, "a.su2: zone 7: keyword 'FFD_NBOX'"));
  CHECK(io::zones_left(read(folder, near, 0).details.get(), "a.su2").empty());
}

TEST_CASE("SU2 zones: the others go back to the byte, the zone that was read as it is now") {
  const TemporaryFolder folder;
  for (const int zone : {1, 7}) {
    io::MeshFile file = read(folder, both, zone);
    io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
    CHECK(read_text(folder / "b.su2") == both);
    file.mesh.coordinates.set_xy(0, {-0.5, 0.25});
    io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
    CHECK(read_text(folder / "b.su2") ==
          replaced(both, zone == 1 ? "\n0 0\n" : "\n5 0\n", "\n-0.5 0.25\n"));
  }
}

TEST_CASE("SU2 zones: several are written back together") {
  const TemporaryFolder folder;
  io::MeshFile first = read(folder, both, 1), second = read(folder, both, 7);
  first.mesh.coordinates.set_xy(0, {-1, 0});
  second.mesh.coordinates.set_xy(3, {5, 2});
  const std::vector<io::MeshZone> zones{{&second.mesh, second.details.get()},
                                        {&first.mesh, first.details.get()}};
  io::write_mesh_zones(folder / "b.su2", zones);
  CHECK(read_text(folder / "b.su2") ==
        replaced(replaced(both, "\n0 0\n", "\n-1 0\n"), "\n5 1\n", "\n5 2\n"));
  CHECK_THROWS_WITH_AS(io::write_mesh_zones(folder / "b.vtk", zones),
                       doctest::Contains("cannot hold several zones"), UsageError);
}

TEST_CASE("SU2 zones: one alone makes a file without zones; another format holds that one") {
  const TemporaryFolder folder;
  const io::MeshFile second = read(folder, both, 7);
  io::WriteOptions alone;
  alone.zone_alone = true;
  CHECK(io::write_mesh(folder / "b.su2", second.mesh, second.details.get(), alone).empty());
  CHECK(read_text(folder / "b.su2") == far);
  CHECK(any_contains(io::write_mesh(folder / "b.vtk", second.mesh, second.details.get()),
                     "only zone 7 of 2 is written"));
}

TEST_CASE("SU2 zones: a zone whose mesh has changed keeps its number and its neighbours") {
  const TemporaryFolder folder;
  const io::MeshFile second = read(folder, both, 7);
  MeshData data = grid_with_holes(2, Cells::quads, [](Index, Index) { return false; });
  io::write_mesh(folder / "b.su2", make_mesh(data), second.details.get());
  const std::string written = read_text(folder / "b.su2");
  CHECK(written.starts_with(both.substr(0, both.find("IZONE= 7"))));
  CHECK(io::read_mesh(folder / "b.su2", {.zone = 7}).mesh.topology->element_count() ==
        data.element_count());
}

TEST_CASE("SU2 zones: the dimension may stand before the first one") {
  const TemporaryFolder folder;
  const std::string text =
      "NDIME= 2\n" + replaced(replaced(both, "NDIME= 2\n", ""), "NDIME= 2\n", "");
  const io::MeshFile file = read(folder, text, 7);
  CHECK(file.mesh.coordinates.size() == 4);
  io::WriteOptions alone;
  alone.zone_alone = true;
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get(), alone);
  CHECK(io::read_mesh(folder / "b.su2").mesh.coordinates.size() == 4);
}

TEST_CASE("SU2 zones: what does not fit is refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read(folder, both, 2), doctest::Contains("no zone 2"), UsageError);
  CHECK_THROWS_WITH_AS(read(folder, near, 2), doctest::Contains("no zone 2"), UsageError);
  CHECK(read(folder, near, 1).details->zones.empty());
  CHECK_THROWS_AS(io::read_mesh(test::test_data("square.obj"), {.zone = 1}), Error);
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.su2", replaced(both, part, by));
  };
  CHECK_CONTAINS(error("NZONE= 2", "NZONE= 3"),
                 "a.su2:1: found 2 IZONE= in the file, expected 3 as NZONE= says");
  CHECK_CONTAINS(error("IZONE= 7", "IZONE= 1"), "a.su2:17: found a second zone 1");
  CHECK_CONTAINS(error("IZONE= 7", "IZONE= x"), "a.su2:17: found IZONE= 'x'");
  // An error in a zone names its own line.
  write_text(folder / "a.su2", replaced(both, "6 1\n", "6 x\n"));
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "a.su2", {.zone = 7}),
                       doctest::Contains("a.su2:25: found 'x', expected y of point 3 of 4"),
                       InputError);
  CHECK(io::read_mesh(folder / "a.su2", {.zone = 1}).mesh.coordinates.size() == 4);
}

}  // namespace winslow::test
