#include "io/support/volume_samples.h"

namespace winslow::test {
namespace {

const std::string two_cells =
    "MeshVersionFormatted 2\nDimension 3\n# marker 4 wing tip\n# region 9 air\nVertices\n6\n"
    "0 0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 0\n2 0 0 0\nEdges\n1\n1 2 8\n"
    "Triangles\n3\n1 3 2 4\n1 2 4 4\n2 3 5 0\nTetrahedra\n2\n1 2 3 4 9\n2 3 4 5 0\n"
    "RequiredVertices\n1\n3\nEnd\n";

}  // namespace

TEST_CASE("Medit: references are tags, comments names; other sections are kept") {
  const std::string text = replaced(two_cells, "6\n0 0 0 1", "5\n0 0 0 1");
  const io::MeshFile file = read_from_text("a.mesh", replaced(text, "2 0 0 0\n", ""));
  CHECK(any_contains(file.warnings, "RequiredVertices of the file are kept as they are"));
  CHECK(any_contains(file.warnings, "1 faces have the reference 0"));
  const Topology& topology = *file.mesh.topology;
  REQUIRE(topology.markers().size() == 1);
  CHECK(topology.markers()[0].name == "wing tip");
  CHECK(topology.markers()[0].tag == 4);
  CHECK(topology.markers()[0].faces == std::vector<Face>{Face(0, 2, 1), Face(0, 1, 3)});
  CHECK(topology.regions()[0].name == "air");
  CHECK(topology.element_regions()[1] == -1);
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.mesh", file.mesh, file.details.get());
  CHECK(read_text(folder / "b.mesh") == replaced(text, "2 0 0 0\n", ""));
}

TEST_CASE("Medit: plane meshes, of Dimension 2 and of 3") {
  Random random(3);
  const Mesh mesh = make_mesh(shuffled_mesh(random, true));
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.mesh", mesh, nullptr);
  CHECK_CONTAINS(read_text(folder / "a.mesh"), "Dimension 2\n");
  const io::MeshFile file = io::read_mesh(folder / "a.mesh");
  CHECK(file.mesh.coordinates == mesh.coordinates);
  CHECK(file.mesh.topology->markers()[1].faces == mesh.topology->markers()[1].faces);
  CHECK(file.mesh.topology->regions()[1].name == mesh.topology->regions()[1].name);
  const io::MeshFile upright = read_from_text("b.mesh",
                                              "MeshVersionFormatted 1\nDimension\n3\nVertices 3\n0 "
                                              "5 0 0 1 5 0 0 0 5 1 0\nTriangles 1 1 2 3 "
                                              "0\nEnd\n");
  CHECK(upright.mesh.coordinates.xy(2) == Vec2(0, 1));
  CHECK(upright.details->plane != nullptr);
  io::write_mesh(folder / "c.mesh", upright.mesh, upright.details.get());
  CHECK_CONTAINS(read_text(folder / "c.mesh"), "\n0 5 1 0\n");
}

TEST_CASE("Medit: bad input is refused with file and line") {
  const auto error = [](const std::string& part, const std::string& by) {
    return input_error("a.mesh", replaced(two_cells, part, by));
  };
  CHECK_CONTAINS(error("Tetrahedra\n2", "Tetrahedra\n3"),
                 "expected a vertex of entry Tetrahedra 3 of 3");
  CHECK_CONTAINS(error("1 2 3 4 9", "1 2 3 7 9"), "a.mesh:23: element 0 uses node 6");
  CHECK_CONTAINS(error("1 2 4 4", "1 2 7 4"), "a.mesh:19: found vertex 7, expected 1 to 6");
  CHECK_CONTAINS(error("1 2 4 4", "1 2 0 4"), "a.mesh:19: found vertex 0, expected 1 or more");
  CHECK_CONTAINS(error("1 2 4 4", "1 2 5 4"), "a.mesh:19: face 1 of marker 'wing tip'");
  CHECK_CONTAINS(error("1 1 1 0", "1 inf 1 0"), "a.mesh:11: found inf as a coordinate of node 4");
  CHECK_CONTAINS(error("Dimension 3", "Dimension 4"),
                 "a.mesh:2: found Dimension 4, expected 2 or 3");
  CHECK_CONTAINS(error("Vertices\n6", "Vertices\n600000000"),
                 "a.mesh:6: found 600000000 as the num");
  CHECK_CONTAINS(error("Vertices\n6", "Vertices\n5"), "found '2', expected a keyword");
  CHECK_CONTAINS(error("Formatted 2", "Formatted 7"), "found 7 as version");
  CHECK_CONTAINS(error("Edges\n", "Vertices\n"), "found 'Vertices', expected each keyword once");
}

TEST_CASE("Medit: references of elements are regions, which meet where references differ") {
  const auto text = [](const std::string& reference) {
    return "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
           "Triangles\n2\n1 2 3 4\n1 3 4 " +
           reference + "\nEnd\n";
  };
  const Mesh two = read_from_text("a.mesh", text("7")).mesh;
  REQUIRE(two.topology->interfaces().size() == 1);
  CHECK(two.topology->name_of(two.topology->interfaces()[0]) == "region_4 and region_7");
  CHECK(read_from_text("a.mesh", text("4")).mesh.topology->interfaces().empty());
}

}  // namespace winslow::test
