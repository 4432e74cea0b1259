#include "io/support/volume_samples.h"

namespace winslow::test {
namespace {

/// A prism on the unit square's half with a pyramid on its slanted side, as VTK numbers a wedge.
const std::string two_solids =
    "% made by hand\nNDIME= 3\nNELEM= 2\n13 0 2 1 3 5 4 0\n14 1 2 5 4 6 1\nNPOIN= 7\n"
    "0 0 0 0\n1 0 0 1\n0 1 0 2\n0 0 1 3\n1 0 1 4\n0 1 1 5\n1 1 0.5 6\n"
    "NMARK= 2\nMARKER_TAG= wall\nMARKER_ELEMS= 3\n5 0 1 2 0\n5 3 4 5 1\n9 0 1 4 3 2\n"
    "MARKER_TAG= far\nMARKER_ELEMS= 5\n9 0 2 5 3 0\n5 1 2 6 1\n5 1 4 6 2\n5 4 5 6 3\n5 5 2 6 4\n";

}  // namespace

TEST_CASE("SU2 with NDIME= 3: elements, markers of triangles and quadrilaterals, comments") {
  const io::MeshFile file = read_from_text("a.su2", two_solids);
  CHECK(file.warnings.empty());
  const Topology& topology = *file.mesh.topology;
  CHECK(topology.cell_dimension() == 3);
  CHECK(topology.element_type(0) == ElementType::prism);
  CHECK(topology.element_type(1) == ElementType::pyramid);
  CHECK(topology.element(0)[1] == 1);  // the wedge of VTK is the mirror image
  CHECK(file.mesh.coordinates.xyz(6) == Vec3(1, 1, 0.5));
  REQUIRE(topology.markers().size() == 2);
  CHECK(topology.markers()[0].name == "wall");
  CHECK(topology.markers()[0].faces[2] == Face(0, 1, 4, 3));
  CHECK(topology.markers()[1].faces[1] == Face(1, 2, 6));
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.su2") == two_solids);
}

TEST_CASE("SU2 with NDIME= 3: points before the dimension, and numbers behind them or none") {
  const auto points = two_solids.find("NPOIN"), marks = two_solids.find("NMARK"),
             elements = two_solids.find("NDIME");
  const std::string turned = two_solids.substr(points, marks - points) +
                             two_solids.substr(elements, points - elements) +
                             two_solids.substr(marks);
  check_same_mesh(read_from_text("a.su2", turned).mesh, read_from_text("a.su2", two_solids).mesh);
  CHECK_CONTAINS(input_error("a.su2", replaced(two_solids, "0 0 1 3\n", "0 1 3\n")),
                 "a.su2:10: found the end of the line, expected three coordinates before");
}

TEST_CASE("SU2 with NDIME= 3: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.su2", replaced(two_solids, part, by));
  };
  CHECK(error("14 1 2", "5 1 2") ==
        "a.su2:5: found element type 5 (a surface element in a volume mesh, as the first element "
        "is of one), "
        "expected 10 (tetrahedron), 12 (hexahedron), "
        "13 (prism) or 14 (pyramid)");
  CHECK(error("5 0 1 2 0", "3 0 1 0") ==
        "a.su2:17: found marker element type 3, expected 5 (triangle) or 9 (quadrilateral)");
  CHECK_CONTAINS(error("9 0 2 5 3 0", "12 0 2 5 3 0"), "marker element type 12 (a 3D element)");
  CHECK_CONTAINS(error("5 1 2 6 1", "5 1 3 6 1"), "a.su2:23: ");
  CHECK_CONTAINS(error("1 1 0.5 6", "1 1 nan 6"), "a.su2:13: found nan as a coordinate of node 6");
  CHECK_CONTAINS(error("14 1 2 5 4 6", "14 1 2 5 4 7"), "a.su2:5: element 1 uses node 7");
  CHECK_CONTAINS(error("NDIME= 3\n", ""), "a.su2:3: found element type 13 (a 3D mesh)");
}

TEST_CASE("SU2 with NDIME= 3: zones are read and written one by one") {
  const std::string body = two_solids.substr(two_solids.find("NDIME"));
  const std::string both = "NZONE= 2\nIZONE= 1\n" + body + "IZONE= 2\n" + body;
  const TemporaryFolder folder;
  write_text(folder / "a.su2", both);
  const io::MeshFile second = io::read_mesh(folder / "a.su2", {.zone = 2});
  CHECK(second.details->zones == std::vector<int>{1, 2});
  CHECK(second.mesh.topology->element_count() == 2);
  io::write_mesh(folder / "b.su2", second.mesh, second.details.get());
  CHECK(read_text(folder / "b.su2") == both);
}

}  // namespace winslow::test
