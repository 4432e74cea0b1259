#include "io/support/volume_samples.h"

namespace winslow::test {
namespace {

/// Two tetrahedra in two volumes; a surface in a group, one that a group holds reversed, and a
/// curve, which means nothing to a mesh of volumes.
const std::string two_volumes =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n3\n2 7 \"wall\"\n3 1 \"left\"\n3 2 \"right\"\n$EndPhysicalNames\n"
    "$Entities\n0 1 2 2\n1 0 0 0 1 0 0 0 0\n1 0 0 0 1 1 0 1 7 0\n2 0 0 0 0 1 1 1 -7 0\n"
    "1 0 0 0 1 1 1 1 1 0\n2 0 0 0 1 1 1 1 2 0\n$EndEntities\n"
    "$Nodes\n1 5 1 9\n3 1 0 5\n1\n2\n3\n4\n9\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
    "$Elements\n5 6 1 6\n1 1 1 1\n1 1 2\n2 1 2 1\n2 1 3 2\n2 2 2 1\n3 1 3 4\n"
    "3 1 4 1\n4 1 2 3 4\n3 2 4 1\n6 2 3 4 9\n$EndElements\n";

}  // namespace

TEST_CASE("MSH 4.1: physical volumes are regions, physical surfaces are markers") {
  const std::string text = replaced(two_volumes, "5 6 1 6", "5 5 1 6");
  const io::MeshFile file = read_from_text("a.msh", text);
  const Topology& topology = *file.mesh.topology;
  CHECK(topology.cell_dimension() == 3);
  REQUIRE(topology.regions().size() == 2);
  CHECK(topology.regions()[1].name == "right");
  CHECK(topology.element_regions()[1] == 1);
  REQUIRE(topology.markers().size() == 1);
  CHECK(topology.markers()[0].name == "wall");
  CHECK(topology.markers()[0].tag == 7);
  REQUIRE(topology.markers()[0].faces.size() == 2);
  CHECK(topology.markers()[0].faces[0] == Face(0, 2, 1));
  CHECK(topology.markers()[0].faces[1] == Face(0, 2, 3).reversed());
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.msh", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.msh") == text);
}

TEST_CASE("MSH: surfaces in no group are kept, but are no marker") {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "$EndNodes\n$Elements\n3\n1 1 2 0 1 1 2\n2 2 2 0 1 1 3 2\n3 4 2 5 1 1 2 3 4\n$EndElements\n";
  const io::MeshFile file = read_from_text("a.msh", text);
  CHECK(any_contains(file.warnings, "1 surface elements are in no physical group"));
  CHECK(file.mesh.topology->regions()[0].name == "volume_5");
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.msh", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.msh") == text);
}

TEST_CASE("MSH of volumes: bad input is refused with file and line") {
  const std::string good = replaced(two_volumes, "5 6 1 6", "5 5 1 6");
  const auto error = [&](const std::string& part, const std::string& by) {
    return input_error("a.msh", replaced(good, part, by));
  };
  CHECK_CONTAINS(error("4 1 2 3 4\n", "4 1 2 3\n"), "found the end of the line, expected element");
  CHECK_CONTAINS(error("4 1 2 3 4\n", "4 1 2 3 5\n"), "found node 5, expected the tag of a node");
  CHECK_CONTAINS(error("2 1 3 2\n", "2 1 3 9\n"), "expected a face of an element");
  CHECK_CONTAINS(error("1 1 1\n$EndN", "1 1 inf\n$EndN"), "found inf as a coordinate of node 4");
  CHECK_CONTAINS(error("1 1 1\n$EndN", "0 0 1\n$EndN"), "node");
}

}  // namespace winslow::test
