#include "io/support/mutations.h"
#include "io/support/samples.h"
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

/// Surfaces in SU2 files: NDIME= 3, triangles and quadrilaterals, markers of lines.
namespace {

/// Two sides of a box and a triangle between their upper edges.
const std::string roof =
    "% a roof\nNDIME= 3\nNELEM= 3\n9 0 1 4 3 0\n9 1 2 5 4 1\n5 3 4 5 2\nNPOIN= 6\n"
    "0 0 0 0\n1 0 0 1\n1 1 0 2\n0 0 1.25 3\n1 0 1.25 4\n1 1 1.25 5\n"
    "NMARK= 2\nMARKER_TAG= foot\nMARKER_ELEMS= 2\n3 0 1 0\n3 1 2 1\n"
    "MARKER_TAG= eaves\nMARKER_ELEMS= 1\n3 5 3 0\n";

std::string written_back(const std::string& text) {
  const TemporaryFolder folder;
  write_text(folder / "a.su2", text);
  const io::MeshFile file = io::read_mesh(folder / "a.su2");
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  return read_text(folder / "b.su2");
}

}  // namespace

TEST_CASE("SU2, surfaces: elements, border markers, comments and numbers come back to the byte") {
  const io::MeshFile file = read_from_text("a.su2", roof);
  CHECK(any_contains(file.warnings, "boundary"));  // three border edges are in no marker
  const Topology& topology = *file.mesh.topology;
  CHECK(is_surface(topology));
  CHECK(topology.element_type(1) == ElementType::quadrilateral);
  CHECK(topology.element_type(2) == ElementType::triangle);
  CHECK(file.mesh.coordinates.xyz(5) == Vec3(1, 1, 1.25));
  REQUIRE(topology.markers().size() == 2);
  CHECK(topology.markers()[0].name == "foot");
  CHECK(topology.markers()[0].faces == std::vector<Face>{{0, 1}, {1, 2}});
  CHECK(topology.markers()[1].faces == std::vector<Face>{{5, 3}});
  CHECK(written_back(roof) == roof);
}

TEST_CASE("SU2, surfaces: sections in any order, closed ones, and zones beside other meshes") {
  const auto elements = roof.find("NELEM"), points = roof.find("NPOIN"), marks = roof.find("NMARK");
  const std::string turned = roof.substr(marks) + roof.substr(points, marks - points) +
                             "% 10 0 1 2 3\n\n" + roof.substr(elements, points - elements) +
                             "NDIME= 3\n";
  check_same_mesh(read_from_text("a.su2", turned).mesh, read_from_text("a.su2", roof).mesh);
  CHECK(written_back(turned) == turned);

  const std::string closed =
      "NDIME= 3\nNELEM= 4\n5 0 2 1\n5 0 1 3\n5 1 2 3\n5 2 0 3\nNPOIN= 4\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\nNMARK= 0\n";
  CHECK(is_surface(*read_from_text("a.su2", closed).mesh.topology));
  CHECK(written_back(closed) == closed);

  const std::string volume =
      "NDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string zones = "NZONE= 3\nIZONE= 1\n" + roof.substr(9) + "IZONE= 2\n" + volume +
                            "NMARK= 0\nIZONE= 3\n" + closed;
  const TemporaryFolder folder;
  write_text(folder / "a.su2", zones);
  for (const int zone : {1, 2, 3}) {
    const io::MeshFile file = io::read_mesh(folder / "a.su2", {.zone = zone});
    CHECK(is_surface(*file.mesh.topology) == (zone != 2));
    io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
    CHECK(read_text(folder / "b.su2") == zones);
  }
}

TEST_CASE(
    "SU2, surfaces: one whose nodes lie in a plane is a plane mesh, and goes back into space") {
  // Seen against -y the elements go round clockwise.
  const std::string wall =
      "NDIME= 3\nNELEM= 2\n5 0 2 1\n5 0 3 2\nNPOIN= 4\n0 2 0\n1 2 0\n1 2 1\n0 2 1\n"
      "NMARK= 1\nMARKER_TAG= floor\nMARKER_ELEMS= 1\n3 0 1\n";
  io::MeshFile file = read_from_text("a.su2", wall);
  CHECK(file.mesh.topology->space_dimension() == 2);
  CHECK(file.mesh.coordinates.xy(2) == Vec2(1, 1));
  CHECK(written_back(wall) == wall);
  CHECK(written_back(replaced(wall, "1 2 1", "1 2.5 1")) == replaced(wall, "1 2 1", "1 2.5 1"));

  const TemporaryFolder folder;
  file.mesh.coordinates.set_xy(2, {1, 1.5});
  CHECK_FALSE(any_contains(io::write_mesh(folder / "b.su2", file.mesh, file.details.get()),
                           "where the plane lies is lost"));
  CHECK(read_text(folder / "b.su2") == replaced(wall, "1 2 1", "1 2 1.5"));

  // At a constant z, and into another format and back.
  const std::string level =
      "NDIME= 3\nNELEM= 2\n5 0 1 2\n5 0 2 3\nNPOIN= 4\n0 0 2\n1 0 2\n1 1 2\n0 1 2\n"
      "NMARK= 1\nMARKER_TAG= floor\nMARKER_ELEMS= 1\n3 0 1\n";
  CHECK(read_from_text("a.su2", level).mesh.topology->space_dimension() == 2);
  CHECK(written_back(level) == level);
  io::write_mesh(folder / "c.vtk", file.mesh, file.details.get());
  const io::MeshFile other = io::read_mesh(folder / "c.vtk");
  CHECK(any_contains(io::write_mesh(folder / "d.su2", other.mesh, other.details.get()),
                     "where the plane lies is lost"));
  CHECK_CONTAINS(read_text(folder / "d.su2"), "NDIME= 2\n");
}

TEST_CASE("SU2, surfaces: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.su2", replaced(roof, part, by));
  };
  CHECK(error("9 1 2 5 4 1", "10 1 2 5 4 1") ==
        "a.su2:5: found element type 10 (a volume element in a surface mesh, as the first element "
        "is of one), expected 5 (triangle) or 9 (quadrilateral)");
  CHECK_CONTAINS(error("9 0 1 4 3 0", "10 0 1 4 3 0"),
                 "a.su2:5: found element type 9 (a surface element in a volume mesh, as the first "
                 "element is of one), expected 10 (tetrahedron)");
  CHECK(error("3 1 2 1", "5 1 2 5 1") ==
        "a.su2:18: found marker element type 5 (in a surface mesh, whose markers are lines), "
        "expected 3 (line)");
  CHECK_CONTAINS(error("9 1 2 5 4 1", "23 1 2 5 4 1"),
                 "a.su2:5: found element type 23 (second order)");
  CHECK_CONTAINS(error("3 5 3 0", "3 5 1 0"), "a.su2:21: ");
  CHECK_CONTAINS(error("3 5 3 0", "3 5 6 0"), "a.su2:21: ");
  CHECK_CONTAINS(error("5 3 4 5 2", "5 3 4 6 2"),
                 "a.su2:6: element 2 uses node 6, expected 0 to 5");
  CHECK_CONTAINS(error("5 3 4 5 2", "5 0 1 5 2"), "a.su2:");
  CHECK_CONTAINS(error("1 1 0 2", "1 nan 0 2"), "a.su2:10: found nan as a coordinate of node 2");
  CHECK_CONTAINS(error("1 1 0 2", "1 1 2"), "a.su2:10: found the end of the line, expected three");
  CHECK_CONTAINS(error("1 1 0 2", "1 1"),
                 "a.su2:10: found the end of the line, expected z of point");
  CHECK_CONTAINS(error("NDIME= 3", "NDIME= 2"), "a.su2:");
  CHECK_CONTAINS(error("NELEM= 3", "NELEM= 0"), "a.su2:");
}

TEST_CASE("SU2, surfaces: no damaged file does anything but give a mesh or an InputError") {
  const TemporaryFolder folder;
  int meshes = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < mutation_count(400); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    write_text(folder / "a.su2", mutated(roof, random));
    try {
      const io::MeshFile file = io::read_mesh(folder / "a.su2");
      io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
      check_same_mesh(io::read_mesh(folder / "b.su2").mesh, file.mesh);
      ++meshes;
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(meshes > 0);
  CHECK(refused > 0);
}

}  // namespace winslow::test
