#include "core/quality/quality.h"
#include "io/support/volume_samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

/// A pyramid on a hexahedron; its quadrilateral is nodes 1 4 5 2 of the element, its apex node 3.
const std::string grid =
    "9 4 5 0 1 0 1\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n0.5 0.5 2\n"
    "5 6 9\n6 7 9\n7 8 9\n8 5 9\n1 4 3 2\n1 2 6 5\n2 3 7 6\n3 4 8 7\n4 1 5 8\n"
    "7\n7\n7\n7\n2\n3\n3\n3\n3\n5 8 9 6 7\n1 2 3 4 5 6 7 8\n";
const std::string names = "3\n7 4000 roof\n2 6662 floor\n3 5000 wall\n";

io::MeshFile read_pair(const TemporaryFolder& folder, const std::string& main,
                       const std::string& mapbc) {
  write_text(folder / "a.ugrid", main);
  write_text(folder / "a.mapbc", mapbc);
  return io::read_mesh(folder / "a.ugrid");
}

}  // namespace

TEST_CASE("UGRID: elements, surfaces by number, their names from the file beside it") {
  const TemporaryFolder folder;
  const io::MeshFile file = read_pair(folder, grid, names);
  CHECK(file.warnings.empty());
  const Topology& topology = *file.mesh.topology;
  CHECK(topology.element_type(0) == ElementType::pyramid);
  CHECK(topology.element(0)[4] == 8);
  CHECK(topology.element(0)[1] == 5);
  REQUIRE(topology.markers().size() == 3);
  CHECK(topology.markers()[0].name == "roof");
  CHECK(topology.markers()[0].tag == 7);
  CHECK(topology.markers()[1].name == "floor");
  CHECK(file.details->roles.symmetry ==
        std::vector<std::pair<std::string, std::string>>{{"floor", "6662"}});
  CHECK(topology.markers()[2].faces[0] == Face(0, 1, 5, 4));
  io::write_mesh(folder / "b.ugrid", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.ugrid") == grid);
  CHECK(read_text(folder / "b.mapbc") == names);
}

TEST_CASE(
    "UGRID: names go to the end of the line, without quotes; the file goes back to the byte") {
  const TemporaryFolder folder;
  const std::string text =
      "  3\n7 4000  wall low  \n2 6662 \"symm x\"\n\n3\t5000 wall_low ! comment\n-1 0 behind\n";
  const io::MeshFile file = read_pair(folder, grid, text);
  const Markers& markers = file.mesh.topology->markers();
  REQUIRE(markers.size() == 3);
  CHECK(markers[0].name == "wall low");
  CHECK(markers[1].name == "symm x");
  CHECK(markers[2].name == "wall_low");
  io::write_mesh(folder / "b.ugrid", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.ugrid") == grid);
  CHECK(read_text(folder / "b.mapbc") == text);
}

TEST_CASE("UGRID: surfaces of one name are one marker, and keep their numbers") {
  const TemporaryFolder folder;
  const std::string text = "4\n7 4000 wall\n2 6662 floor\n3 5000 wall\n9 1 wall\n";
  const io::MeshFile file = read_pair(folder, grid, text);
  CHECK(file.warnings.empty());
  const Markers& markers = file.mesh.topology->markers();
  REQUIRE(markers.size() == 2);
  CHECK(markers[0].name == "wall");
  CHECK(markers[0].faces.size() == 8);
  CHECK(markers[1].name == "floor");
  io::write_mesh(folder / "b.lb8.ugrid", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.mapbc") == text);
  io::write_mesh(folder / "c.ugrid", io::read_mesh(folder / "b.lb8.ugrid").mesh, nullptr);
  io::write_mesh(folder / "d.ugrid", file.mesh, file.details.get());
  CHECK(read_text(folder / "d.ugrid") == grid);
  // A mesh of another file has one surface for each marker.
  CHECK(read_text(folder / "c.mapbc") == "2\n7 0 wall\n2 0 floor\n");
}

TEST_CASE("UGRID: names of other formats are written so that they are read as themselves") {
  for (const char* name : {"wall low", "\"in quotes\"", "'both\"", " begins with a blank", "x"}) {
    CAPTURE(name);
    MeshData data = cube(1, Volumes::hexahedra);
    data.markers.resize(1);
    data.markers[0].name = name;
    const TemporaryFolder folder;
    const Mesh mesh = make_mesh(data);
    for (const std::string& warning : io::write_mesh(folder / "a.ugrid", mesh, nullptr))
      CHECK_FALSE(contains(warning, "is written as"));
    CHECK(io::read_mesh(folder / "a.ugrid").mesh.topology->markers()[0].name == name);
  }
}

TEST_CASE("UGRID without .mapbc: surfaces are called after their numbers") {
  const io::MeshFile file = read_from_text("a.ugrid", grid);
  CHECK(file.mesh.topology->markers()[0].name == "surface_7");
}

TEST_CASE(
    "UGRID: the extension before .ugrid says how a file is written, its size how it is read") {
  const io::MeshFile file = read_from_text("a.ugrid", grid);
  const TemporaryFolder folder;
  std::vector<std::size_t> sizes;
  for (const char* name : {"b.b8.ugrid", "b.lb8.ugrid", "b.b4.ugrid", "b.lb4.ugrid"}) {
    CAPTURE(name);
    io::write_mesh(folder / name, file.mesh, file.details.get());
    check_same_mesh(io::read_mesh(folder / name).mesh, file.mesh);
    const std::string bytes = read_text(folder / name);
    sizes.push_back(bytes.size());
    CHECK(bytes[0] == (std::string(name).find(".l") == std::string::npos ? '\0' : '\x09'));
    write_text(folder / "misnamed.ugrid", bytes);
    CHECK(io::read_mesh(folder / "misnamed.ugrid").mesh.coordinates == file.mesh.coordinates);
  }
  write_text(folder / "misnamed.b8.ugrid", grid);
  check_same_mesh(io::read_mesh(folder / "misnamed.b8.ugrid").mesh, file.mesh);
  CHECK(sizes[0] == sizes[1]);
  CHECK(sizes[0] - sizes[2] == 9 * 12);
  CHECK(sizes[2] == sizes[3]);
}

TEST_CASE("UGRID: records of Fortran and integers of 64 bits") {
  const io::MeshFile file = read_from_text("a.ugrid", grid);
  const TemporaryFolder folder;
  // A mesh has 9 nodes, 9 + 9 + 5 + 1 + 1 other entries, 7 counts and 4 records' lengths.
  const std::size_t reals = 9 * 3, integers = 7 + 4 * 4 + 5 * 5 + 5 + 8;
  for (const std::string order : {"", "l"}) {
    for (const std::string kind : {"b", "r"}) {
      for (const std::string real : {"8", "4"}) {
        for (const std::string wide : {"", "l"}) {
          const std::string name = "b." + order + kind + real + wide + ".ugrid";
          CAPTURE(name);
          CHECK(io::write_mesh(folder / name, file.mesh, file.details.get()).empty());
          const std::string bytes = read_text(folder / name);
          CHECK(bytes.size() == reals * (real == "8" ? 8 : 4) + integers * (wide == "l" ? 8 : 4) +
                                    (kind == "r" ? 16 : 0));
          const io::MeshFile back = io::read_mesh(folder / name);
          CHECK(back.warnings.empty());
          check_same_mesh(back.mesh, file.mesh);
          write_text(folder / "misnamed.ugrid", bytes);
          check_same_mesh(io::read_mesh(folder / "misnamed.ugrid").mesh, file.mesh);
          // The same bytes again, in the encoding of the source.
          io::write_mesh(folder / ("c." + order + kind + real + wide + ".ugrid"), back.mesh,
                         back.details.get());
          CHECK(read_text(folder / ("c." + order + kind + real + wide + ".ugrid")) == bytes);
          CHECK_CONTAINS(input_error(name.c_str(), bytes.substr(0, bytes.size() - 40)), name);
        }
      }
    }
  }
}

TEST_CASE("UGRID: two hexahedra as AFLR3 writes them with Fortran and with integers of 64 bits") {
  const auto file = [](const char* name) { return io::read_mesh(test_data(name)); };
  const io::MeshFile big = file("two_hexahedra.r8.ugrid");
  CHECK(big.mesh.topology->element_count() == 2);
  CHECK(big.mesh.topology->node_count() == 12);
  CHECK(big.mesh.topology->markers().unmarked_faces() == 0);
  CHECK(measure_quality(big.mesh).inverted == 0);
  check_same_mesh(file("two_hexahedra.lr8.ugrid").mesh, big.mesh);
  check_same_mesh(file("two_hexahedra.lb8l.ugrid").mesh, big.mesh);
}

TEST_CASE("UGRID: parts of a record of Fortran may end within a number") {
  const io::MeshFile file = read_from_text("a.ugrid", grid);
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.lr8.ugrid", file.mesh, nullptr);
  const std::string bytes = read_text(folder / "b.lr8.ugrid");
  const auto length = [](int n) {
    std::string text;
    for (int k = 0; k < 4; ++k) text += static_cast<char>(n >> (8 * k) & 0xff);
    return text;
  };
  const std::string rest = bytes.substr(40, bytes.size() - 44);
  const int first = 13, last = static_cast<int>(rest.size()) - first;
  const std::string split = bytes.substr(0, 36) + length(-first) + rest.substr(0, 13) +
                            length(first) + length(last) + rest.substr(13) + length(-last);
  check_same_mesh(read_from_text("b.lr8.ugrid", split).mesh, file.mesh);
}

TEST_CASE("UGRID: single precision rounds, with a warning") {
  Random random(4);
  const Mesh mesh = make_mesh(volume_sample(random, Volumes::tetrahedra, false));
  const TemporaryFolder folder;
  CHECK(any_contains(io::write_mesh(folder / "a.b4.ugrid", mesh, nullptr), "are rounded"));
  const io::MeshFile file = io::read_mesh(folder / "a.b4.ugrid");
  const Vec3 rounded = mesh.coordinates.xyz(0).cast<float>().cast<double>();
  CHECK(file.mesh.coordinates.xyz(0) == rounded);
}

TEST_CASE("UGRID: what a file cannot hold is said, a plane mesh is refused") {
  Random random(5);
  const Mesh mesh = make_mesh(volume_sample(random, Volumes::mixed, true));
  const TemporaryFolder folder;
  const auto warnings = io::write_mesh(folder / "a.ugrid", mesh, nullptr);
  CHECK(any_contains(warnings, "their order has changed"));
  CHECK(any_contains(warnings, "names of element sets are not written"));
  CHECK_THROWS_WITH_AS(
      io::write_mesh(folder / "b.ugrid", make_mesh(square(2, Cells::quads)), nullptr),
      doctest::Contains("AFLR3 files cannot hold a plane mesh"), UsageError);
}

TEST_CASE("UGRID: bad input is refused with file and line, or byte") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.ugrid", replaced(grid, part, by));
  };
  CHECK(error("5 6 9\n", "5 6 10\n") ==
        "a.ugrid:11: found node 10, expected 1 to 9 as a node of boundary face 1 of 9");
  CHECK_CONTAINS(error("5 6 9\n", "5 7 9\n"), "a.ugrid:11: ");
  CHECK_CONTAINS(error("0.5 0.5 2", "0.5 x 2"), "a.ugrid:10: found 'x', expected a coordinate");
  CHECK_CONTAINS(error("0.5 0.5 2", "0.5 nan 2"),
                 "a.ugrid:10: found nan as a coordinate of node 8");
  CHECK_CONTAINS(error("9 4 5", "999999999 4 5"), "a.ugrid:1: found 999999999 as the number of no");
  CHECK_CONTAINS(error("1 2 3 4 5 6 7 8\n", "1 2 3 4 5 6 7\n"), "expected hexahedron 1 of 1");
  CHECK_CONTAINS(error("0 1 0 1\n", "0 0 0 0\n"), "a.ugrid:1: found no element with a volume");
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_pair(folder, grid, "2\n7 4000 roof\n7 1 floor\n"),
                       doctest::Contains("a.mapbc:3: found surface 7 a second time"), InputError);
  CHECK_THROWS_WITH_AS(read_pair(folder, grid, "1\n7 roof\n"),
                       doctest::Contains("a.mapbc:2: found 'roof', expected the boundary cond"),
                       InputError);
  CHECK_THROWS_WITH_AS(read_pair(folder, grid, "3\n7 4000 roof\n"),
                       doctest::Contains("a.mapbc:2: found the end of the"), InputError);
  io::write_mesh(folder / "b.lb8.ugrid", read_from_text("a.ugrid", grid).mesh, nullptr);
  std::string bytes = read_text(folder / "b.lb8.ugrid");
  bytes[28 + 9 * 24] = 77;
  CHECK(input_error("b.lb8.ugrid", bytes) ==
        "b.lb8.ugrid: byte 244: found node 77, expected 1 to 9 as a node of boundary face 1 of 9");
  CHECK_CONTAINS(input_error("b.lb8.ugrid", bytes.substr(0, 300)), "b.lb8.ugrid: byte ");
}

}  // namespace winslow::test
