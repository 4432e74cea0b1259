#include <cstdint>
#include <cstring>

#include "io/support/samples.h"
#include "io/support/volume_samples.h"
#include "io/vtk/lz4.h"
#include "io/vtk/vtu_arrays.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

const std::string legacy = read_text(test::test_data("square.vtk"));
const std::string legacy_binary = read_text(test::test_data("square_b.vtk"));
const std::string xml = read_text(test::test_data("square.vtu"));
const std::string xml_binary = read_text(test::test_data("square_b.vtu"));

const io::MeshFile& expected() {
  static const io::MeshFile file = io::read_mesh(test::test_data("square.su2"));
  return file;
}

const std::string points =
    "0 0 0\n0.5 0 0\n1 0 0\n0 0.5 0\n0.5 0.5 0\n1 0.5 0\n0 1 0\n0.5 1 0\n1 1 0\n";

}  // namespace

TEST_CASE("VTK and VTU hold the mesh of the SU2 file, markers included") {
  for (const char* name : {"square.vtk", "square_b.vtk", "square.vtu", "square_b.vtu"}) {
    CAPTURE(name);
    const io::MeshFile file = io::read_mesh(test::test_data(name));
    check_same_mesh(file.mesh, expected().mesh);
    CHECK(file.details->binary == contains(name, "_b."));
  }
}

TEST_CASE("VTK: cells may come in any order, with vertices and lines of no marker, and keep it") {
  std::string text = replaced(legacy, "CELLS 10 38\n", "CELLS 12 43\n1 4\n2 3 6\n");
  text = replaced(text, "CELL_TYPES 10\n", "CELL_TYPES 12\n1\n3\n");
  text = replaced(text, "CELL_DATA 10", "CELL_DATA 12");
  text = replaced(text, "marker 1 10 int\n", "marker 1 12 int\n0\n0\n");
  const TemporaryFolder folder;
  write_text(folder / "a.vtk", text);
  const io::MeshFile file = io::read_mesh(folder / "a.vtk");
  check_same_mesh(file.mesh, expected().mesh);
  CHECK(any_contains(file.warnings, "1 line cells have no marker tag"));
  io::write_mesh(folder / "b.vtk", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.vtk") == text);
}

TEST_CASE("VTK: version 5 with offsets, attributes of every kind, metadata, encoded names") {
  const std::string text =
      "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "FIELD FieldData 2\nmarker:lower%20wall 1 1 int\n1\nTITLE 1 1 string\nany%20title\n"
      "METADATA\nINFORMATION 0\n\n"
      "POINTS 9 float\n" +
      points +
      "METADATA\nINFORMATION 1\nNAME L2 LOCATION vtk\nDATA 2 0 1\n\n"
      "CELLS 9 26\nOFFSETS vtktypeint64\n0 4 8 11 14 17 20 22 24\n"
      "CONNECTIVITY vtktypeint64\n0 1 4 3 1 2 5 4 3 4 6 4 7 6 4 5 7 5 8 7 0 1 1 2\n"
      "CELL_TYPES 8\n9 9 5 5 5 5 3 3\n"
      "POINT_DATA 9\nSCALARS p float 1\nLOOKUP_TABLE mine\n1 2 3 4 5 6 7 8 9\n"
      "LOOKUP_TABLE mine 1\n0 0 0 1\nVECTORS v float\n"
      "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
      "CELL_DATA 8\nFIELD FieldData 1\nmarker 1 8 int\n0 0 0 0 0 0 1 1\n"
      "GLOBAL_IDS id int\n0 1 2 3 4 5 6 7\n";
  const io::MeshFile file = read_from_text("a.vtk", replaced(text, "CELLS 9 26", "CELLS 9 24"));
  CHECK(file.mesh.topology->element_count() == 6);
  REQUIRE(file.mesh.topology->markers().size() == 1);
  CHECK(file.mesh.topology->markers()[0].name == "lower wall");
  CHECK(file.details->data_names() == "TITLE, id, mine, p, v");
  CHECK_CONTAINS(input_error("a.vtk", text), "a.vtk:33: found 'CELL_TYPES', expected a node");
}

TEST_CASE("VTK: polygon data, pixels and polylines become elements and marker edges") {
  const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET ";
  const io::MeshFile polygons = read_from_text(
      "a.vtk", head + "POLYDATA\nPOINTS 9 double\n" + points +
                   "POLYGONS 6 26\n4 0 1 4 3\n4 1 2 5 4\n3 3 4 6\n3 4 7 6\n3 4 5 7\n3 5 8 7\n");
  Comparison plain;
  plain.markers = false;
  check_same_mesh(polygons.mesh, expected().mesh, plain);
  CHECK_FALSE(polygons.mesh.topology->markers().from_file());
  const io::MeshFile pixels =
      read_from_text("a.vtk", head + "UNSTRUCTURED_GRID\nPOINTS 9 double\n" + points +
                                  "CELLS 3 14\n4 0 1 3 4\n4 1 2 4 5\n3 0 1 2\nCELL_TYPES 3\n8 8 4\n"
                                  "CELL_DATA 3\nSCALARS marker int\nLOOKUP_TABLE default\n0 0 9\n");
  const auto corners = pixels.mesh.topology->element(1);
  CHECK(std::vector<Index>(corners.begin(), corners.end()) == std::vector<Index>{1, 2, 5, 4});
  REQUIRE(pixels.mesh.topology->markers().size() == 1);
  CHECK(pixels.mesh.topology->markers()[0].name == "marker_9");
  CHECK(pixels.mesh.topology->markers()[0].faces.size() == 2);
}

TEST_CASE("VTK: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.vtk", replaced(legacy, part, by));
  };
  CHECK_CONTAINS(input_error("a.vtk", legacy.substr(0, legacy.find("1 0.5 0"))),
                 "a.vtk:5: found 9 as the number of points, expected no more than the 8");
  CHECK_CONTAINS(error("POINTS 9", "POINTS 10"), "a.vtk:15: found 'CELLS', expected a coordinate");
  CHECK_CONTAINS(error("POINTS 9", "POINTS 8"), "a.vtk:14: found '1', expected a keyword");
  CHECK_CONTAINS(error("POINTS 9", "POINTS 900000000000"), "a.vtk:5: found 900000000000");
  CHECK_CONTAINS(error("CELLS 10 38", "CELLS 10 39"), "found 'CELL_TYPES', expected a number");
  CHECK_CONTAINS(error("CELLS 10 38", "CELLS 11 38"), "expected 11 cells");
  CHECK(
      contains(error("CELLS 10 38", "CELLS 10 38000000000000"), "a.vtk:15: found 38000000000000"));
  CHECK_CONTAINS(error("CELL_TYPES 10\n9\n", "CELL_TYPES 9\n"), "found 9 cell types, expected 10");
  CHECK(error("3 5 8 7", "3 5 9 7") == "a.vtk:21: found node 9, expected 0 to 8");
  CHECK(error("3 5 8 7", "3 5 -1 7") == "a.vtk:21: found node -1, expected 0 to 8");
  CHECK_CONTAINS(error("3 5 8 7", "3 5 5 7"), "a.vtk:21: element 5 uses node 5 twice");
  CHECK_CONTAINS(error("3 5 8 7", "99 5 8 7"), "a.vtk:21: found 99 as the size of a cell");
  CHECK_CONTAINS(error("1 0.5 0", "1 nan 0"), "a.vtk:11: found nan");
  CHECK(is_surface(*read_from_text("a.vtk", replaced(legacy, "1 0.5 0", "1 0.5 3")).mesh.topology));
  CHECK_CONTAINS(error("CELL_TYPES 10\n9", "CELL_TYPES 10\n10"),
                 "a.vtk:16: element 0 has no volume");
  CHECK_CONTAINS(error("CELL_TYPES 10\n9", "CELL_TYPES 10\n22"), "(second or higher order)");
  CHECK_CONTAINS(error("CELL_TYPES 10\n9", "CELL_TYPES 10\n5"), "a.vtk:16: found 4 nodes");
  CHECK_CONTAINS(error("CELL_DATA 10", "CELL_DATA 9"), "found data for 9 cells, expected 10");
  CHECK(
      contains(error("UNSTRUCTURED_GRID", "STRUCTURED_GRID"), "a.vtk:4: found 'STRUCTURED_GRID'"));
  CHECK_CONTAINS(error("marker 1 10 int", "marker 1 10 thing"), "found 'thing', expected a type");
}

TEST_CASE("VTK binary: bad input is refused with the byte") {
  const std::size_t data = legacy_binary.find("POINTS 9 double\n") + 16;
  // Little-endian numbers in a file that is big-endian by definition: 0.5 becomes another number.
  std::string swapped = legacy_binary;
  for (std::size_t i = 0; i < 27; ++i) {
    std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(data + 8 * i),
                 swapped.begin() + static_cast<std::ptrdiff_t>(data + 8 * i + 8));
  }
  CHECK_CONTAINS(input_error("a.vtk", swapped), "a.vtk: byte ");
  const std::size_t cells = legacy_binary.find("CELLS 10 38\n") + 12;
  swapped = legacy_binary;
  std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(cells),
               swapped.begin() + static_cast<std::ptrdiff_t>(cells) + 4);
  CHECK_CONTAINS(input_error("a.vtk", swapped),
                 "a.vtk: byte " + std::to_string(cells) + ": found 67108864 as the size of a cell");
  for (const std::size_t keep : {data + 100, cells + 10, legacy_binary.size() - 20}) {
    CHECK_CONTAINS(input_error("a.vtk", legacy_binary.substr(0, keep)), "the file");
  }
}

TEST_CASE("VTU: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.vtu", replaced(xml, part, by));
  };
  CHECK_CONTAINS(input_error("a.vtu", xml.substr(0, xml.find("1 0.5 0"))), "malformed XML");
  CHECK_CONTAINS(error("</Points>", "</Point>"), "a.vtu:25: found malformed XML");
  CHECK_CONTAINS(error("1 0.5 0\n", "1 0.5\n"), "found 26 coordinates, expected three");
  CHECK_CONTAINS(error("1 0.5 0\n", "1 x 0\n"), "a.vtu:20: found 'x', expected a number");
  CHECK_CONTAINS(error("1 0.5 0\n", "1 nan 0\n"), "a.vtu:20: found nan");
  CHECK(
      is_surface(*read_from_text("a.vtu", replaced(xml, "1 0.5 0\n", "1 0.5 1\n")).mesh.topology));
  CHECK_CONTAINS(error("Points=\"9\"", "Points=\"8\""), "found NumberOfPoints='8', expected 9");
  CHECK_CONTAINS(error("Cells=\"10\"", "Cells=\"99999999999\""), "found NumberOfCells=");
  CHECK_CONTAINS(error("0 1 4 3", "0 1 4 9"), "a.vtu:28: found node 9, expected 0 to 8");
  CHECK_CONTAINS(error("4 8 11", "4 3 11"), "a.vtu:33: found 3 as the offset of a cell");
  CHECK_CONTAINS(error("26 28", "26 29"), "a.vtu:33: found 29 as the offset of a cell");
  CHECK_CONTAINS(error("26 28", "26 27"), "expected 27, the last offset");
  CHECK_CONTAINS(error("9 9 5 5", "10 9 5 5"), "element 0 has no volume");
  CHECK_CONTAINS(error("9 9 5 5", "9 9 5"), "found 9 cell types, expected 10");
  CHECK_CONTAINS(error("0 0 0 0 0 0 1", "0 0 0 0 0 1"),
                 "found 9 values in array 'marker', expected 10 times 1");
  CHECK_CONTAINS(error("type=\"UnstructuredGrid\"", "type=\"PolyData\""),
                 "a.vtu:1: found a VTK file that is no unstructured grid");
  CHECK_CONTAINS(error("type=\"UnstructuredGrid\"", "type=\"Table\""),
                 "a.vtu:2: found VTKFile type");
  CHECK_CONTAINS(error("LittleEndian", "MiddleEndian"), "byte_order 'MiddleEndian'");
  CHECK_CONTAINS(error("Float64", "Float65"), "type 'Float65'");
  CHECK_CONTAINS(error("Name=\"offsets\"", "Name=\"other\""), "no array \"offsets\"");
}

TEST_CASE("VTU appended: truncated data, wrong sizes and offsets are refused") {
  const std::size_t data = xml_binary.find("_", xml_binary.find("<AppendedData")) + 1;
  CHECK_CONTAINS(input_error("a.vtu", xml_binary.substr(0, data + 100)), "a.vtu:");
  std::string huge = xml_binary;
  const std::uint64_t size = 1ULL << 62;
  std::memcpy(huge.data() + data, &size, sizeof size);
  CHECK_CONTAINS(input_error("a.vtu", huge), "found 4611686018427387904 bytes in array");
  CHECK_CONTAINS(input_error("a.vtu", replaced(xml_binary, "offset=\"0\"", "offset=\"100000\"")),
                 "offset '100000'");
  CHECK(
      contains(input_error("a.vtu", replaced(xml_binary, "LittleEndian", "BigEndian")), "a.vtu:"));
}

TEST_CASE(
    "VTK: names of markers follow the cells, where Gmsh takes them; before POINTS they are read") {
  CHECK(legacy.find("FIELD") > legacy.find("CELL_TYPES"));
  CHECK(legacy.find("FIELD") < legacy.find("CELL_DATA"));
  const auto begin = legacy.find("FIELD"), end = legacy.find("CELL_DATA");
  const std::string names = legacy.substr(begin, end - begin);
  const std::string old = replaced(replaced(legacy, names, ""), "POINTS", names + "POINTS");
  check_same_mesh(read_from_text("a.vtk", old).mesh, expected().mesh);
}

TEST_CASE("VTU: compressed data that declares too much is refused before it is unpacked") {
  const auto bytes = [](std::uint32_t value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto with = [&](const std::string& name, std::uint32_t size, std::uint32_t packed) {
    const std::string array = "Name=\"" + name + "\" format=\"ascii\">";
    const auto begin = xml.find(array);
    REQUIRE(begin != std::string::npos);
    const auto end = xml.find("</DataArray>", begin);
    const std::string data =
        io::vtk::encode_base64(bytes(1) + bytes(size) + bytes(size) + bytes(packed)) +
        io::vtk::encode_base64(std::string(packed, '\0'));
    std::string text =
        xml.substr(0, begin) + "Name=\"" + name + "\" format=\"binary\">" + data + xml.substr(end);
    text = replaced(text, "header_type=\"UInt64\"", "header_type=\"UInt32\"");
    return replaced(text, "<VTKFile ", "<VTKFile compressor=\"vtkZLibDataCompressor\" ");
  };
  CHECK_CONTAINS(input_error("a.vtu", with("connectivity", 5000000, 10000)),
                 "found 10000 bytes that are to unpack to 5000000 in array 'connectivity', "
                 "expected no more than 200 times as many");
  CHECK_CONTAINS(input_error("a.vtu", with("types", 64000, 100)),
                 "found 64000 bytes in array 'types', expected 10 numbers, 10 bytes");
}

TEST_CASE("VTU: inline base64, appended base64, both byte orders, zlib blocks") {
  const std::string x = "AAAAAAAA8D8=";  // 1.0, little-endian
  CHECK(io::vtk::decode_base64(x)->size() == 8);
  CHECK(io::vtk::encode_base64(*io::vtk::decode_base64(x)) == x);
  CHECK(*io::vtk::decode_base64("YQ==YmM= ZGVm") == "abcdef");
  CHECK_FALSE(io::vtk::decode_base64("YQ=a"));
  CHECK_FALSE(io::vtk::decode_base64("YQ="));
  CHECK_FALSE(io::vtk::decode_base64("Y!=="));
  // Written by VTK-like writers (see tests/interop for those of meshio): header apart from data.
  const auto bytes = [](const auto& value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  std::string coordinates;
  const auto& mesh = expected().mesh;
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    coordinates +=
        bytes(mesh.coordinates.xy(i).x()) + bytes(mesh.coordinates.xy(i).y()) + bytes(0.0);
  }
  const auto size = static_cast<std::uint64_t>(coordinates.size());
  const std::string apart =
      io::vtk::encode_base64(bytes(size)) + io::vtk::encode_base64(coordinates);
  const std::string together = io::vtk::encode_base64(bytes(size) + coordinates);
  const std::size_t begin = xml.find("0 0 0\n0.5");
  const std::size_t end = xml.find("</DataArray>", begin);
  for (const std::string& text : {apart, together}) {
    std::string inlined = xml.substr(0, begin) + text + xml.substr(end);
    const std::string open = "NumberOfComponents=\"3\" format=";
    check_same_mesh(
        read_from_text("a.vtu", replaced(inlined, open + "\"ascii\"", open + "\"binary\"")).mesh,
        mesh);
    std::string appended = xml.substr(0, begin) + xml.substr(end);
    appended = replaced(appended, open + "\"ascii\"", open + "\"appended\" offset=\"0\"");
    appended = replaced(appended, "</VTKFile>",
                        "<AppendedData encoding=\"base64\">\n _" + text +
                            "QUFBQUFBQUE=\n</AppendedData>\n</VTKFile>");
    check_same_mesh(read_from_text("a.vtu", appended).mesh, mesh);
  }
}

namespace {

/// Packs bytes as LZ4 does, without looking for repetitions: literals alone.
std::string lz4_of_literals(const std::string& bytes) {
  std::string packed;
  std::size_t rest = bytes.size();
  packed += static_cast<char>(std::min<std::size_t>(rest, 15) << 4);
  if (rest >= 15) {
    for (rest -= 15; rest >= 255; rest -= 255) packed += '\xff';
    packed += static_cast<char>(rest);
  }
  return packed + bytes;
}

}  // namespace

TEST_CASE("LZ4: literals, copies that overlap, damage") {
  const auto unpacked = [](std::string_view packed,
                           std::size_t size) -> std::optional<std::string> {
    std::string bytes(size, '?');
    if (!io::vtk::unpack_lz4(packed, bytes)) return std::nullopt;
    return bytes;
  };
  CHECK(unpacked(lz4_of_literals("hello"), 5) == "hello");
  const std::string longer(700, 'x');
  CHECK(unpacked(lz4_of_literals(longer), 700) == longer);
  // "ab", then 4 + 4 bytes from 2 before, then the literal "c".
  const std::string repeats(
      "\x24"
      "ab"
      "\x02\x00"
      "\x10"
      "c",
      7);
  CHECK(unpacked(repeats, 11) ==
        "ababababab"
        "c");
  // 15 + 255 + 1 + 4 copies of one byte.
  const std::string run(
      "\x1f"
      "z"
      "\x01\x00"
      "\xff\x01"
      "\x10"
      "!",
      8);
  CHECK(unpacked(run, 277) == std::string(276, 'z') + "!");
  CHECK_FALSE(unpacked(repeats, 10));
  CHECK_FALSE(unpacked(repeats, 12));
  for (std::size_t size = 1; size < repeats.size() - 1; ++size)
    CHECK_FALSE(unpacked(repeats.substr(0, size), 11));
  CHECK_FALSE(unpacked(std::string("\x14"
                                   "a"
                                   "\x02\x00"
                                   "\x10"
                                   "c",
                                   6),
                       10));  // before the start
  CHECK_FALSE(unpacked(std::string("\x14"
                                   "a"
                                   "\x00\x00"
                                   "\x10"
                                   "c",
                                   6),
                       10));
}

TEST_CASE("VTU: arrays compressed by LZ4 are read; LZMA is refused with ParaView's way out") {
  const auto bytes = [](const auto& value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  std::string coordinates;
  const auto& mesh = expected().mesh;
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    coordinates +=
        bytes(mesh.coordinates.xy(i).x()) + bytes(mesh.coordinates.xy(i).y()) + bytes(0.0);
  // Two blocks: all but 24 bytes, and these.
  const std::string first = coordinates.substr(0, coordinates.size() - 24);
  const std::string last = coordinates.substr(coordinates.size() - 24);
  const std::string packed_first = lz4_of_literals(first), packed_last = lz4_of_literals(last);
  const auto number = [&](std::size_t value) { return bytes(static_cast<std::uint64_t>(value)); };
  const std::string header = number(2) + number(first.size()) + number(last.size()) +
                             number(packed_first.size()) + number(packed_last.size());
  const std::size_t begin = xml.find("0 0 0\n0.5");
  const std::size_t end = xml.find("</DataArray>", begin);
  const std::string data =
      io::vtk::encode_base64(header) + io::vtk::encode_base64(packed_first + packed_last);
  std::string text = xml.substr(0, begin) + data + xml.substr(end);
  const std::string open = "NumberOfComponents=\"3\" format=";
  text = replaced(text, open + "\"ascii\"", open + "\"binary\"");
  const auto with = [&](const std::string& compressor) {
    return replaced(text, "<VTKFile ", "<VTKFile compressor=\"" + compressor + "\" ");
  };
  check_same_mesh(read_from_text("a.vtu", with("vtkLZ4DataCompressor")).mesh, mesh);
  CHECK_CONTAINS(input_error("a.vtu", with("vtkZLibDataCompressor")), "that zlib refuses");
  const std::string refusal = input_error("a.vtu", with("vtkLZMADataCompressor"));
  CHECK_CONTAINS(refusal,
                 "found compressor 'vtkLZMADataCompressor', expected vtkZLibDataCompressor, "
                 "vtkLZ4DataCompressor or none; ParaView writes it so: pvpython -c \"from "
                 "paraview.simple import *; SaveData('");
  CHECK_CONTAINS(refusal, "a_saved.vtu', OpenDataFile('");
  CHECK_CONTAINS(refusal, "a.vtu'), CompressorType='ZLib')\"");
}

namespace {

/// A voxel, a wedge as VTK numbers it, and two boundary cells, one of them a pixel.
const std::string solid_cells =
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n"
    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n2 0 0\n2 0 1\n"
    "CELLS 5 28\n8 0 1 2 3 4 5 6 7\n6 1 3 8 5 7 9\n4 0 1 2 3\n3 1 3 8\n2 0 1\n"
    "CELL_TYPES 5\n11\n13\n8\n5\n3\n"
    "CELL_DATA 5\nSCALARS marker int 1\nLOOKUP_TABLE default\n0\n0\n3\n3\n3\n";

}  // namespace

TEST_CASE("VTK: voxels are hexahedra, pixels quadrilaterals, wedges the mirror image of prisms") {
  const io::MeshFile file = read_from_text("a.vtk", solid_cells);
  CHECK(any_contains(file.warnings, "boundary faces belong to no marker"));
  CHECK_FALSE(any_contains(file.warnings, "turned inside out"));
  const Topology& topology = *file.mesh.topology;
  REQUIRE(topology.element_count() == 2);
  CHECK(topology.element_type(0) == ElementType::hexahedron);
  CHECK(topology.element(0)[2] == 3);
  CHECK(topology.element_type(1) == ElementType::prism);
  CHECK(topology.element(1)[1] == 8);
  REQUIRE(topology.markers().size() == 1);
  CHECK(topology.markers()[0].name == "marker_3");
  CHECK(topology.markers()[0].faces == std::vector<Face>{Face(0, 1, 3, 2), Face(1, 3, 8)});
}

TEST_CASE("VTK: what is written is a wedge in VTK's numbering") {
  const io::MeshFile file = read_from_text("a.vtk", solid_cells);
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.vtk", file.mesh, file.details.get());
  CHECK_CONTAINS(read_text(folder / "b.vtk"), "\n6 1 3 8 5 7 9\n");
}

TEST_CASE("VTK of volumes: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.vtk", replaced(solid_cells, part, by));
  };
  CHECK(error("CELL_TYPES 5\n11", "CELL_TYPES 5\n42") ==
        "a.vtk:17: found 8 numbers for the faces of cell 0, a polyhedron, that do not fit each "
        "other, expected the number of its faces, then of each the number of nodes and the nodes");
  CHECK_CONTAINS(error("11\n13", "11\n14"), "a.vtk:18: found 6 nodes in a cell of type 14");
  CHECK_CONTAINS(error("11\n13", "12\n13"), "a.vtk:");
  CHECK_CONTAINS(error("3 1 3 8", "3 1 4 8"), "a.vtk:20: ");
  CHECK_CONTAINS(error("2 0 1\n", "2 0 nan\n"), "a.vtk:15: found nan as a coordinate");
}

}  // namespace winslow::test
