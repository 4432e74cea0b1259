#include "io/support/samples.h"
#include "io/vtk/data_arrays.h"
#include "io/vtk/grid.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

using io::vtk::DataArray;
using io::vtk::ValueKind;
using io::vtk::ValueType;

const std::string square_cells =
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
    "0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\nCELLS 3 14\n4 0 1 4 3\n4 1 2 5 4\n3 0 1 2\n"
    "CELL_TYPES 3\n9\n9\n4\n";

std::string with_cell_data(const std::string& more) {
  return square_cells + "CELL_DATA 3\n" + more;
}

/// The text of the file after reading and writing.
std::string written_again(const std::string& text, const Mesh* other = nullptr) {
  const TemporaryFolder folder;
  const io::MeshFile file = read_from_text("a.vtk", text);
  io::write_mesh(folder / "b.vtk", other ? *other : file.mesh, file.details.get());
  return read_text(folder / "b.vtk");
}

}  // namespace

TEST_CASE("VTK arrays: words become bytes of every type, and the same words again") {
  const auto round_trip = [](ValueKind kind, std::size_t bytes, const std::string& word) {
    DataArray array{"x", {kind, bytes}};
    if (!io::vtk::append_value(array.bytes, array.type, word)) return std::string("refused");
    CHECK(array.bytes.size() == bytes);
    std::string text;
    io::vtk::append_text(text, array, 0);
    return text;
  };
  CHECK(round_trip(ValueKind::unsigned_integer, 8, "18446744073709551615") ==
        "18446744073709551615");
  CHECK(round_trip(ValueKind::signed_integer, 8, "-9223372036854775808") == "-9223372036854775808");
  CHECK(round_trip(ValueKind::signed_integer, 1, "-128") == "-128");
  CHECK(round_trip(ValueKind::signed_integer, 1, "128") == "refused");
  CHECK(round_trip(ValueKind::unsigned_integer, 1, "-1") == "refused");
  CHECK(round_trip(ValueKind::unsigned_integer, 4, "4294967296") == "refused");
  CHECK(round_trip(ValueKind::signed_integer, 4, "3.0") == "3");
  CHECK(round_trip(ValueKind::signed_integer, 4, "3.5") == "refused");
  CHECK(round_trip(ValueKind::floating, 4, "0.1") == "0.1");
  CHECK(round_trip(ValueKind::floating, 8, "0.1") == "0.1");
  CHECK(round_trip(ValueKind::floating, 8, "-0") == "-0");
  CHECK(round_trip(ValueKind::floating, 4, "x") == "refused");
  const std::string bits =
      io::vtk::packed_bits({'\1', '\0', '\1', '\1', '\0', '\0', '\0', '\0', '\1'});
  REQUIRE(bits.size() == 2);
  CHECK(static_cast<unsigned char>(bits[0]) == 0xB0);
  CHECK(io::vtk::bit_at(bits, 8));
  CHECK_FALSE(io::vtk::bit_at(bits, 1));
}

TEST_CASE("VTK arrays: bits and texts of a legacy file come back") {
  const std::string data = "FIELD fields 2\nmask 1 3 bit\n1 0 1\nnames 1 3 string\na%20b\n\nc\n";
  const std::string again = written_again(with_cell_data(data));
  CHECK_CONTAINS(again, "CELL_DATA 3\nFIELD fields 2\nmask 1 3 bit\n1\n0\n1\n");
  CHECK_CONTAINS(again, "names 1 3 string\na%20b\n\nc\n");
}

TEST_CASE("VTK: polylines stay one cell, so that cell arrays keep their cells") {
  const std::string data = "SCALARS T double 1\nLOOKUP_TABLE default\n0.5\n0.25\n7\n";
  const std::string again = written_again(with_cell_data(data));
  CHECK_CONTAINS(again, "CELLS 3 14\n4 0 1 4 3\n4 1 2 5 4\n3 0 1 2\nCELL_TYPES 3\n9\n9\n4\n");
  CHECK_CONTAINS(again, data.substr(0, data.find("0.5")));
  CHECK(again.find("marker") == std::string::npos);
}

TEST_CASE("VTK: lines with a tag in an array of regions are markers") {
  const io::MeshFile file = read_from_text(
      "a.vtk", with_cell_data("SCALARS MaterialIDs int 1\nLOOKUP_TABLE d\n0\n4\n9\n"));
  const Topology& topology = *file.mesh.topology;
  REQUIRE(topology.regions().size() == 2);
  CHECK(topology.regions()[0].name == "region_0");
  CHECK(topology.regions()[1].tag == 4);
  REQUIRE(topology.markers().size() == 1);
  CHECK(topology.markers()[0].name == "marker_9");
  CHECK(topology.markers()[0].faces.size() == 2);
  CHECK(file.details->regions_array == "MaterialIDs");
  CHECK(topology.interfaces().size() == 1);
}

TEST_CASE("VTK: data of a mesh that is no longer that of the file are named") {
  const TemporaryFolder folder;
  const io::MeshFile file =
      read_from_text("a.vtk", with_cell_data("SCALARS T double 1\nLOOKUP_TABLE d\n0\n4\n9\n"));
  const Mesh other = make_mesh(square(2, Cells::quads));
  const auto warnings = io::write_mesh(folder / "b.vtk", other, file.details.get());
  CHECK(any_contains(warnings, "no longer that of the file: the data on its points, cells"));
  CHECK(any_contains(warnings, "not written: T"));
  CHECK(read_text(folder / "b.vtk").find("\nT ") == std::string::npos);
}

TEST_CASE("VTK: damaged data are refused with file and line") {
  const auto error = [](const std::string& data) {
    return input_error("a.vtk", with_cell_data(data));
  };
  CHECK_CONTAINS(error("FIELD f 1\nT 1 2 double\n1 2\n"),
                 "a.vtk:22: found 2 values in cell array \"T\", expected 3");
  CHECK_CONTAINS(error("SCALARS T int\nLOOKUP_TABLE d\n1 2 x\n"),
                 "a.vtk:23: found 'x', expected a value of a data array");
  CHECK_CONTAINS(error("SCALARS T unsigned_char\nLOOKUP_TABLE d\n1 2 300\n"), "found '300'");
  CHECK_CONTAINS(error("SCALARS T int\nLOOKUP_TABLE d\n1 2\n"), "the end of the file");
}

}  // namespace winslow::test
