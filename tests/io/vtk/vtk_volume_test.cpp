#include "io/support/volume_samples.h"

namespace winslow::test {
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
        "a.vtk:17: found cell type 42 (a polyhedron), expected a line (3), triangle (5), "
        "quadrilateral (9), tetrahedron (10), hexahedron (12), wedge (13) or pyramid (14)");
  CHECK_CONTAINS(error("11\n13", "11\n14"), "a.vtk:18: found 6 nodes in a cell of type 14");
  CHECK_CONTAINS(error("11\n13", "12\n13"), "a.vtk:");
  CHECK_CONTAINS(error("3 1 3 8", "3 1 4 8"), "a.vtk:20: ");
  CHECK_CONTAINS(error("2 0 1\n", "2 0 nan\n"), "a.vtk:15: found nan as a coordinate");
}

}  // namespace winslow::test
