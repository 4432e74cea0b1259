#include <bit>
#include <set>
#include <sstream>

#include "core/quality/quality.h"
#include "io/support/files.h"
#include "io/support/polyhedra_samples.h"

/// Polyhedra (cell type 42) in VTK files.
namespace winslow::test {
namespace {

/// A hexahedron below a polyhedron, and a quadrilateral of a marker. The polyhedron is the cube on
/// the hexahedron.
const std::string points =
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n0 0 2\n1 0 2\n1 1 2\n0 1 2\n";

std::string array(const std::string& name, const std::string& values,
                  const std::string& type = "Int64") {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">\n" + values +
         "\n</DataArray>\n";
}

const std::string stream =
    "6\n4 4 7 6 5\n4 8 9 10 11\n4 4 5 9 8\n4 5 6 10 9\n4 6 7 11 10\n4 7 4 8 11";

std::string vtu(const std::string& faces, const std::string& version = "1.0") {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"" + version +
         "\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
         "<Piece NumberOfPoints=\"12\" NumberOfCells=\"3\">\n<Points>\n"
         "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n" +
         points + "</DataArray>\n</Points>\n<Cells>\n" +
         array("connectivity", "0 1 2 3 4 5 6 7 4 5 6 7 8 9 10 11 0 1 2 3") +
         array("offsets", "8 16 20") + array("types", "12 42 9", "UInt8") + faces +
         "</Cells>\n<PointData>\n" + array("T", "0 1 2 3 4 5 6 7 8 9 10 11", "Int32") +
         "</PointData>\n<CellData>\n" + array("marker", "0 0 5", "Int32") +
         "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string classic(const std::string& faces, const std::string& ends) {
  return vtu(array("faces", faces) + array("faceoffsets", ends));
}

/// The six faces of the polyhedron as VTK 9.4 lists them, and a seventh that no cell has.
const std::string table_nodes = "4 7 6 5 8 9 10 11 4 5 9 8 5 6 10 9 6 7 11 10 7 4 8 11 0 1 5 4";
const std::string table_ends = "4 8 12 16 20 24 28";

std::string tables(const std::string& faces_of_cells, const std::string& cell_ends) {
  return vtu(array("face_connectivity", table_nodes) + array("face_offsets", table_ends) +
                 array("polyhedron_to_faces", faces_of_cells) +
                 array("polyhedron_offsets", cell_ends),
             "2.3");
}

/// Checks the two cells of vtu().
void check_cubes(const io::MeshFile& file) {
  const Topology& topology = *file.mesh.topology;
  REQUIRE(topology.element_count() == 2);
  CHECK(topology.element_type(0) == ElementType::hexahedron);
  REQUIRE(topology.element_type(1) == ElementType::polyhedron);
  const auto corners = topology.element(1);
  CHECK(std::set<Index>(corners.begin(), corners.end()) ==
        std::set<Index>{4, 5, 6, 7, 8, 9, 10, 11});
  CHECK(faces_of(topology, 1) == std::vector<Face>{Face(4, 5, 9, 8), Face(4, 7, 6, 5),
                                                   Face(4, 8, 11, 7), Face(5, 6, 10, 9),
                                                   Face(6, 7, 11, 10), Face(8, 9, 10, 11)});
  CHECK(measure_quality(file.mesh).inverted == 0);
  CHECK(topology.markers().size() == 1);
}

}  // namespace

TEST_CASE("VTU: polyhedra by their face streams, kept with all arrays") {
  const TemporaryFolder folder;
  const std::string text = classic(stream, "-1 31 -1");
  write_text(folder / "a.vtu", text);
  const io::MeshFile file = io::read_mesh(folder / "a.vtu");
  check_cubes(file);
  CHECK_FALSE(any_contains(file.warnings, "turned"));
  for (const bool binary : {false, true}) {
    io::WriteOptions options;
    options.binary = binary;
    options.keep_encoding = false;
    io::write_mesh(folder / "b.vtu", file.mesh, file.details.get(), options);
    const io::MeshFile again = io::read_mesh(folder / "b.vtu");
    check_cubes(again);
    CHECK(again.details->data_names() == "T");
  }
  io::write_mesh(folder / "b.vtu", file.mesh, file.details.get());
  const std::string written = read_text(folder / "b.vtu");
  CHECK_CONTAINS(written, "Name=\"faces\" format=\"ascii\">\n6 4 4 7 6 5 4 8 9 10 11 4\n");
  CHECK_CONTAINS(written, "Name=\"faceoffsets\" format=\"ascii\">\n-1 31 -1\n");
  CHECK_CONTAINS(written, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"");
}

TEST_CASE("VTU: polyhedra in the four arrays of VTK 9.4, which go back as they came") {
  const TemporaryFolder folder;
  write_text(folder / "a.vtu", tables("0 1 2 3 4 5", "0 6 6"));
  const io::MeshFile file = io::read_mesh(folder / "a.vtu");
  check_cubes(file);
  io::write_mesh(folder / "b.vtu", file.mesh, file.details.get());
  const std::string written = read_text(folder / "b.vtu");
  CHECK_CONTAINS(written, "<VTKFile type=\"UnstructuredGrid\" version=\"2.3\"");
  CHECK_CONTAINS(written, "Name=\"face_offsets\" format=\"ascii\">\n4 8 12 16 20 24 28\n");
  CHECK_CONTAINS(written, "Name=\"polyhedron_to_faces\" format=\"ascii\">\n0 1 2 3 4 5\n");
  CHECK_CONTAINS(written, "Name=\"polyhedron_offsets\" format=\"ascii\">\n0 6 6\n");
  CHECK_FALSE(contains(written, "\"faces\""));
  check_cubes(io::read_mesh(folder / "b.vtu"));
}

TEST_CASE("VTU: faces that are seen from inside, all or some of them") {
  const std::string inside =
      "6\n4 5 6 7 4\n4 11 10 9 8\n4 8 9 5 4\n4 9 10 6 5\n4 10 11 7 6\n4 11 8 4 7";
  const io::MeshFile all = read_from_text("a.vtu", classic(inside, "-1 31 -1"));
  check_cubes(all);
  CHECK(any_contains(all.warnings, "1 elements with mirrored corners were turned inside out"));
  const io::MeshFile some =
      read_from_text("a.vtu", classic(replaced(stream, "4 6 7 11 10", "4 10 11 7 6"), "-1 31 -1"));
  check_cubes(some);
  CHECK(any_contains(some.warnings, "1 polyhedron has some faces seen from inside"));
}

TEST_CASE(
    "VTU: the nodes of a polyhedron are those of its faces, whatever the list of cells says") {
  const std::string text = classic(stream, "-1 31 -1");
  const io::MeshFile other =
      read_from_text("a.vtu", replaced(text, "4 5 6 7 8 9 10 11 0", "4 5 6 7 8 9 10 10 0"));
  CHECK(other.mesh.topology->element(1).size() == 8);
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.vtu", other.mesh, other.details.get());
  CHECK(io::read_mesh(folder / "b.vtu").details->data_names() == "T");
}

TEST_CASE("VTU: faces of polyhedra that fit nothing are refused with file and line") {
  const auto error = [](const std::string& faces, const std::string& ends) {
    return input_error("a.vtu", classic(faces, ends));
  };
  // The faces of the polyhedron begin in line 31.
  CHECK(error(stream, "-1 32 -1") ==
        "a.vtu:40: found 32 as the end of the faces of cell 1, expected 0 to 31");
  CHECK(error(stream, "-1 -1 -1") ==
        "a.vtu:40: found -1 as the end of the faces of cell 1, expected 0 to 31");
  CHECK(error(stream, "-1 30 -1") ==
        "a.vtu:30: found 31 numbers in array \"faces\", expected 30, the last offset");
  CHECK(error(stream, "-1 31") ==
        "a.vtu:39: found 2 numbers in array \"faceoffsets\", expected 3, one for each cell");
  CHECK(error(replaced(stream, "6\n", "7\n"), "-1 31 -1") ==
        "a.vtu:31: found 31 numbers for the faces of cell 1, a polyhedron, that do not fit each "
        "other, expected the number of its faces, then of each the number of nodes and the nodes");
  CHECK_CONTAINS(error(replaced(stream, "4 7 4 8 11", "5 7 4 8 11"), "-1 31 -1"),
                 "that do not fit each other");
  CHECK(error(replaced(stream, "4 7 4 8 11", "4 7 4 8 12"), "-1 31 -1") ==
        "a.vtu:31: found node 12, expected 0 to 11");
  CHECK(error(replaced(stream, "4 7 4 8 11", "4 7 4 8 8"), "-1 31 -1") ==
        "a.vtu:31: found a face with a node twice: nodes 7, 4, 8 and 8 in cell 1, a polyhedron, "
        "expected distinct nodes");
  CHECK(error(replaced(stream, "4 7 4 8 11", "2 7 4 1 8"), "-1 31 -1") ==
        "a.vtu:31: found a face of 2 nodes in cell 1, a polyhedron, expected three or more");
  CHECK_CONTAINS(error(replaced(stream, "4 7 4 8 11", "4 7 4 8 9"), "-1 31 -1"),
                 "at the edge between nodes ");
  CHECK(error("5\n4 4 7 6 5\n4 8 9 10 11\n4 4 5 9 8\n4 5 6 10 9\n4 6 7 11 10", "-1 26 -1") ==
        "a.vtu:31: found 1 face at the edge between nodes 4 and 7 in cell 1, a polyhedron, "
        "expected two: the faces of a cell close");
  CHECK(error("3\n3 4 5 6\n3 4 6 5\n3 4 5 6", "-1 13 -1") ==
        "a.vtu:31: found 3 faces in cell 1, a polyhedron, expected four or more");
  CHECK(input_error("a.vtu", vtu("")) ==
        "a.vtu:20: found no array \"faces\" for the polyhedra (cell type 42), expected \"faces\" "
        "and \"faceoffsets\", or \"face_connectivity\" and the other three of VTK 9.4");
  CHECK_CONTAINS(input_error("a.vtu", vtu(array("faces", stream))), "no array \"faceoffsets\"");
}

TEST_CASE("VTU: a face that three cells have is refused with file and line") {
  // Another polyhedron that lies on the top of the hexahedron.
  std::string text = classic(stream + "\n" + stream, "-1 31 62 -1");
  text = replaced(text, "8 9 10 11 0 1 2 3", "8 9 10 11\n4 5 6 7 8 9 10 11 0 1 2 3");
  text = replaced(replaced(text, "8 16 20", "8 16 24 28"), "12 42 9", "12 42 42 9");
  text = replaced(replaced(text, "NumberOfCells=\"3\"", "NumberOfCells=\"4\""), "0 0 5", "0 0 0 5");
  CHECK(input_error("a.vtu", text) ==
        "a.vtu:23: the face with nodes 4, 7, 6 and 5 is shared by 3 elements, expected at most 2 "
        "(non-manifold); --repair mends it");
}

TEST_CASE("VTU: arrays of VTK 9.4 that do not fit are refused with file and line") {
  const auto error = [](const std::string& faces, const std::string& ends) {
    return input_error("a.vtu", tables(faces, ends));
  };
  CHECK_CONTAINS(error("0 1 2 3 4 7", "0 6 6"),
                 "a.vtu:37: found face 7 in cell 1, expected 0 to 6");
  CHECK_CONTAINS(error("0 1 2 3 4 -1", "0 6 6"), "a.vtu:37: found face -1 in cell 1");
  CHECK_CONTAINS(
      error("0 1 2 3 4 4 4", "0 7 7"),
      "a.vtu:37: found face 4 in cell 1, which two cells have already, expected at most");
  CHECK_CONTAINS(error("0 1 2 3 4 5", "0 7 7"),
                 "a.vtu:40: found 7 as the end of the faces of cell 1, expected 0 to 6");
  CHECK_CONTAINS(error("0 1 2 3 4 5", "1 6 6"),
                 "a.vtu:40: found faces of cell 0, which is no polyhedron, expected none");
  CHECK_CONTAINS(error("0 1 2 3 4 5", "0 5 5"), "a.vtu:36: found 6 numbers in array");
  CHECK_CONTAINS(error("0 1 2 3 4 6", "0 6 6"), "at the edge between nodes");
  const std::string text = tables("0 1 2 3 4 5", "0 6 6");
  CHECK_CONTAINS(input_error("a.vtu", replaced(text, table_ends, "4 8 12 16 20 24 29")),
                 "a.vtu:34: found 29 as the end of the nodes of face 6, expected 24 to 28");
  CHECK_CONTAINS(input_error("a.vtu", replaced(text, table_ends, "4 8 7 16 20 24 28")),
                 "a.vtu:34: found 7 as the end of the nodes of face 2, expected 8 to 28");
  CHECK_CONTAINS(input_error("a.vtu", replaced(text, "\"face_offsets\"", "\"offsets_of_faces\"")),
                 "a.vtu:20: found no array \"face_offsets\"");
}

TEST_CASE("VTU: prisms over pentagons and hexagons are polyhedra") {
  for (const Index n : {5, 6}) {
    MeshData data = stacked_prisms(n);
    data.markers.clear();
    const Mesh mesh = make_mesh(data);
    const TemporaryFolder folder;
    io::write_mesh(folder / "a.vtu", mesh, nullptr);
    std::string text = read_text(folder / "a.vtu");
    const auto first = text.find("<DataArray type=\"Int64\" Name=\"faces\"");
    const auto last = text.find("</Cells>");
    text.erase(first, last - first);
    text = replaced(text, "\n42 42\n", n == 5 ? "\n15 15\n" : "\n16 16\n");
    const io::MeshFile file = read_from_text("a.vtu", text);
    check_same_cells(file.mesh, mesh);
    io::write_mesh(folder / "b.vtu", file.mesh, file.details.get());
    CHECK(read_text(folder / "b.vtu") == text);
  }
}

TEST_CASE("VTU: a convex set of points is refused") {
  CHECK(input_error("a.vtu", replaced(classic(stream, "-1 31 -1"), "12 42 9", "12 41 9")) ==
        "a.vtu:22: found cell type 41 (a convex set of points), expected a line (3), triangle (5), "
        "polygon (7), quadrilateral (9), tetrahedron (10), hexahedron (12), wedge (13), pyramid "
        "(14) or "
        "polyhedron (42)");
}

namespace {

const std::string legacy_points = "DATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n" + points;
const std::string legacy_types = "CELL_TYPES 3\n12\n42\n9\n";
const std::string legacy_data =
    "CELL_DATA 3\nSCALARS marker int 1\nLOOKUP_TABLE default\n0\n0\n5\n"
    "POINT_DATA 12\nSCALARS T float 1\nLOOKUP_TABLE "
    "default\n0\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n";

/// As VTK writes version 4.2: the list of a polyhedron is its face stream.
const std::string legacy =
    "# vtk DataFile Version 4.2\nvtk output\nASCII\n" + legacy_points +
    "CELLS 3 46\n8 0 1 2 3 4 5 6 7 \n31 6 4 4 7 6 5 4 8 9 10 11 4 4 5 9 8 4 5 "
    "6 10 9 4 6 7 11 10 4 7 4 8 11 \n4 0 1 2 3 \n\n" +
    legacy_types + legacy_data;
/// As VTK writes version 5.1: the face stream is the connectivity of a polyhedron.
const std::string legacy_5 =
    "# vtk DataFile Version 5.1\nvtk output\nASCII\n" + legacy_points +
    "CELLS 4 43\nOFFSETS vtktypeint64\n0 8 39 43 \nCONNECTIVITY vtktypeint64\n0 1 2 3 4 5 6 7 6 \n"
    "4 4 7 6 5 4 8 9 10 \n11 4 4 5 9 8 4 5 6 \n10 9 4 6 7 11 10 4 7 \n4 8 11 0 1 2 3 \n" +
    legacy_types + legacy_data;

template <class Number>
std::string big_endian(const std::string& numbers) {
  std::istringstream words(numbers);
  std::string bytes;
  for (Number number = 0; words >> number;) {
    auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
  }
  return bytes + "\n";
}

/// The mesh of legacy_5 in binary.
std::string binary_legacy_5() {
  return "# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 12 double\n" +
         big_endian<double>(points) + "CELLS 4 43\nOFFSETS vtktypeint64\n" +
         big_endian<std::int64_t>("0 8 39 43") + "CONNECTIVITY vtktypeint64\n" +
         big_endian<std::int64_t>("0 1 2 3 4 5 6 7 " + stream + " 0 1 2 3") + "CELL_TYPES 3\n" +
         big_endian<std::int32_t>("12 42 9") + "CELL_DATA 3\nSCALARS marker int 1\n" +
         "LOOKUP_TABLE default\n" + big_endian<std::int32_t>("0 0 5") + "POINT_DATA 12\n" +
         "SCALARS T float 1\nLOOKUP_TABLE default\n" +
         big_endian<float>("0 1 2 3 4 5 6 7 8 9 10 11");
}

}  // namespace

TEST_CASE("VTK: polyhedra of legacy files, of version 4 and of version 5, text and binary") {
  for (const std::string& text : {legacy, legacy_5, binary_legacy_5()}) {
    const TemporaryFolder folder;
    write_text(folder / "a.vtk", text);
    const io::MeshFile file = io::read_mesh(folder / "a.vtk");
    check_cubes(file);
    CHECK(file.details->binary == contains(text, "BINARY"));
    for (const char* name : {"b.vtk", "b.vtu"}) {
      for (const bool binary : {false, true}) {
        io::WriteOptions options;
        options.binary = binary;
        options.keep_encoding = false;
        CHECK(io::write_mesh(folder / name, file.mesh, file.details.get(), options).empty());
        const io::MeshFile again = io::read_mesh(folder / name);
        check_cubes(again);
        CHECK(again.details->data_names() == "T");
        CHECK(again.details->binary == binary);
      }
    }
  }
}

TEST_CASE("VTK: a legacy file lists the face stream of a polyhedron") {
  const io::MeshFile file = read_from_text("a.vtk", legacy);
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.vtk", file.mesh, file.details.get());
  CHECK_CONTAINS(
      read_text(folder / "b.vtk"),
      "\nCELLS 3 46\n8 0 1 2 3 4 5 6 7\n31 6 4 4 7 6 5 4 8 9 10 11 4 4 5 9 8 4 5 6 10 9 4 "
      "6 7 11 10 4 7 4 8 11\n4 0 1 2 3\nCELL_TYPES 3\n12\n42\n9\n");
  // Four arrays of VTK 9.4 become a face stream, too.
  const io::MeshFile of_tables = read_from_text("a.vtu", tables("0 1 2 3 4 5", "0 6 6"));
  io::write_mesh(folder / "c.vtk", of_tables.mesh, of_tables.details.get());
  CHECK_CONTAINS(read_text(folder / "c.vtk"),
                 "\n31 6 4 4 7 6 5 4 8 9 10 11 4 4 5 9 8 4 5 6 10 9 4 ");
  check_cubes(io::read_mesh(folder / "c.vtk"));
}

TEST_CASE("VTK: face streams that fit nothing are refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.vtk", replaced(legacy, part, by));
  };
  const std::string place = "a.vtk:20: found ";
  CHECK(error("31 6 4", "31 7 4") ==
        place +
            "31 numbers for the faces of cell 1, a polyhedron, that do not fit each other, "
            "expected the number of its faces, then of each the number of nodes and the nodes");
  CHECK_CONTAINS(error("4 7 4 8 11", "3 7 4 8 11"), place + "31 numbers for the faces of cell 1");
  CHECK_CONTAINS(error("4 7 4 8 11", "-4 7 4 8 11"), place + "31 numbers for the faces of cell 1");
  CHECK_CONTAINS(error("4 7 4 8 11", "4 7 4 8 12"), place + "node 12, expected 0 to 11");
  CHECK_CONTAINS(error("4 7 4 8 11", "4 7 4 8 4"),
                 place + "a face with a node twice: nodes 7, 4, ");
  CHECK_CONTAINS(error("4 7 4 8 11", "4 7 4 8 9"), " at the edge between nodes ");
  CHECK_CONTAINS(error("46\n8 0", "46\n9 0"), "a.vtk:19: found 46 as the length of the list");
  CHECK_CONTAINS(input_error("a.vtk", replaced(legacy_5, "0 8 39 43", "0 8 38 43")),
                 "a.vtk:22: found 30 numbers for the faces of cell 1");
  CHECK_CONTAINS(input_error("a.vtk", replaced(legacy_5, "0 8 39 43", "0 8 44 43")),
                 "a.vtk:20: found 44 as an offset");
}

}  // namespace winslow::test
