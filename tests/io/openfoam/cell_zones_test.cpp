#include "io/support/volume_samples.h"

namespace winslow::test {
namespace {

namespace fs = std::filesystem;

/// A cube of hexahedra as a polyMesh with a file cellZones.
io::MeshFile read_zones(const TemporaryFolder& folder, const std::string& zones) {
  const fs::path path = folder / "constant/polyMesh";
  if (!fs::exists(path)) io::write_mesh(path, make_mesh(cube(3, Volumes::hexahedra)), nullptr);
  write_text(path / "cellZones", zones);
  return io::read_mesh(path);
}

std::string error_of(const std::string& zones) {
  const TemporaryFolder folder;
  try {
    read_zones(folder, zones);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string head =
    "/* of blockMesh */\nFoamFile\n{\n    version 2.0;\n    format ascii;\n    class "
    "regIOobject;\n}\n";

}  // namespace

TEST_CASE("OpenFOAM: cell zones are regions, cells of no zone are in no region") {
  const TemporaryFolder folder;
  const io::MeshFile file = read_zones(
      folder, head +
                  "3\n(\nrotor // turns\n{\n    type cellZone;\n    cellLabels List<label> \n3\n(\n"
                  "0\n1\n2\n)\n;\n}\nempty { type cellZone; cellLabels List<label> 0(); }\n"
                  "filter { type cellZone; cellLabels 2(2 5); }\n)\n");
  const Topology& topology = *file.mesh.topology;
  REQUIRE(topology.regions().size() == 2);
  CHECK(topology.regions()[0].name == "rotor");
  CHECK(topology.regions()[1].name == "filter");
  const auto of = topology.element_regions();
  CHECK(std::vector<Index>(of.begin(), of.begin() + 6) == std::vector<Index>{0, 0, 0, -1, -1, 1});
  CHECK(any_contains(file.warnings, "1 cell is in several cell zones"));
  CHECK(topology.interfaces().size() == 3);
}

TEST_CASE("OpenFOAM: binary cell zones of 32 and 64 bits give the same regions") {
  for (const std::size_t width : {4U, 8U}) {
    CAPTURE(width);
    std::string labels;
    for (const std::int64_t cell : {7, 40, 26}) {
      const auto bytes = std::bit_cast<std::array<char, 8>>(cell == 40 ? std::int64_t{8} : cell);
      labels.append(bytes.data(), width);
    }
    const std::string binary = "FoamFile { format binary; class regIOobject; arch \"LSB;label=" +
                               std::to_string(8 * width) + ";scalar=64\"; }\n";
    const TemporaryFolder folder;
    const io::MeshFile file =
        read_zones(folder, binary + "1(\nzone\n{\ntype cellZone;\ncellLabels List<label> 3(" +
                               labels + ");\n}\n)\n");
    const auto of = file.mesh.topology->element_regions();
    REQUIRE(of.size() == 27);
    for (Index e = 0; e < 27; ++e)
      CHECK((of[static_cast<std::size_t>(e)] == 0) == (e == 7 || e == 8 || e == 26));
  }
}

TEST_CASE("OpenFOAM: damaged cell zones are refused with file and line") {
  CHECK_CONTAINS(error_of(head + "1(\na { cellLabels 1(27); }\n)\n"),
                 "cellZones:9: found cell 27 in zone 'a', expected 0 to 26");
  CHECK_CONTAINS(error_of(head + "1(\na { cellLabels 99(1 2); }\n)\n"),
                 "cellZones:9: found 99 as the length of a list, expected no more than");
  CHECK_CONTAINS(error_of(head + "1(\na { cellLabels 2(1 x); }\n)\n"),
                 "found 'x', expected a cell");
  CHECK_CONTAINS(error_of(head + "2(\na { cellLabels 1(1); }\n"), "found the end of the file");
  CHECK_CONTAINS(error_of(head + "two\n"), "found 'two', expected the number of zones");
  CHECK_CONTAINS(error_of("FoamFile { format binary; }\n1(a{cellLabels 20(abc"),
                 "found 20 as the length of a list, expected no more than the 2");
}

}  // namespace winslow::test
