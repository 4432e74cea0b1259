#include "io/format/foreign_formats.h"

#include <doctest/doctest.h>

#include <set>

#include "io/support/files.h"

namespace winslow::test {
namespace {

/// A file of another program, and what its refusal must say.
struct Foreign {
  std::string file, content, what, command;
};

std::string vtk_file(const std::string& type) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"0.1\">\n</VTKFile>\n";
}

const std::string hdf5 = "\x89HDF\r\n\x1a\n" + std::string(100, '\0');

/// One file for each row of the table, in its order; extensions that two programs share included.
std::vector<Foreign> foreign_files() {
  const std::string blocks =
      "pvpython -c \"from paraview.simple import *; SaveData('DIR/wing_saved.vtu', "
      "MergeBlocks(OpenDataFile('DIR/wing.";
  return {
      {"wing.msh", "(1 \"TGrid 2D\")\n(2 2)\n(0 grid)\n(10 (0 1 219 0))\n", "ANSYS Fluent",
       "fluentMeshToFoam DIR/wing.msh"},
      {"wing.msh", "(0 \"GAMBIT to Fluent File\")\n\n(0 \"Dimension:\")\n(2 3)\n(10 (0 1 8 0))\n",
       "ANSYS Fluent", "fluent3DMeshToFoam DIR/wing.msh"},
      {"wing.inp", "*Heading\n wing\n*NODE\n1, 0, 0, 0\n", "Abaqus",
       "meshio convert DIR/wing.inp DIR/wing.vtu"},
      {"wing.bdf", "$ Created by Gmsh\nGRID    1       0       0.00    0.00    1.00\n", "Nastran",
       "gmsh DIR/wing.bdf -save -o DIR/wing.msh"},
      {"wing.unv", "    -1\n  2411\n         1         1         1        11\n", "I-deas",
       "gmsh DIR/wing.unv -save -o DIR/wing.msh"},
      {"wing.mesh", "MFEM mesh v1.0\n\ndimension\n2\n", "MFEM", "mesh-explorer -m DIR/wing.mesh"},
      {"wing.xml", "<?xml version=\"1.0\"?>\n<dolfin xmlns:dolfin=\"x\">\n  <mesh/>\n</dolfin>\n",
       "dolfin", "meshio convert DIR/wing.xml DIR/wing.vtu"},
      {"wing.xdmf", "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n</Xdmf>\n", "XDMF",
       "meshio convert DIR/wing.xdmf DIR/wing.vtu"},
      {"wing.pvtu", vtk_file("PUnstructuredGrid"), "several pieces", blocks + "pvtu')))\""},
      {"wing.vtm", vtk_file("vtkMultiBlockDataSet"), "several blocks", blocks + "vtm')))\""},
      {"wing.vtp", vtk_file("PolyData"), "no unstructured grid", "OpenDataFile('DIR/wing.vtp')"},
      {"wing.meshb", std::string("\1\0\0\0\3\0\0\0", 8), "binary Medit",
       "meshio convert DIR/wing.meshb DIR/wing.mesh"},
      {"wing.med", hdf5, "Salome", "meshio convert DIR/wing.med DIR/wing.vtu"},
      {"wing.e", std::string("CDF\1", 4), "Exodus", "meshio convert DIR/wing.e DIR/wing.vtu"},
      {"wing.vol", "mesh3d\ndimension\n3\n", "Netgen", "meshio convert DIR/wing.vol DIR/wing.vtu"},
      {"wing.neu", "        CONTROL INFO 2.4.6\n** GAMBIT NEUTRAL FILE\n", "Gambit",
       "gambitToFoam DIR/wing.neu"},
      {"wing.dat", "TITLE = \"wing\"\nVARIABLES = \"X\" \"Y\"\nZONE N=4, E=1\n", "Tecplot",
       "meshio convert DIR/wing.dat DIR/wing.vtu"},
      {"wing.step", "ISO-10303-21;\nHEADER;\n", "STEP", "gmsh DIR/wing.step -3 -o DIR/wing.msh"},
      {"wing.geo", "Point(1) = {0, 0, 0};\n", "script of Gmsh",
       "gmsh DIR/wing.geo -3 -o DIR/wing.msh"}};
}

std::string error_of(const std::filesystem::path& path) {
  try {
    io::read_mesh(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "read";
}

}  // namespace

TEST_CASE("files of other programs are refused by name, with the command that converts them") {
  const TemporaryFolder folder;
  std::set<std::string_view> met;
  for (const Foreign& file : foreign_files()) {
    CAPTURE(file.file);
    const auto path = folder / file.file;
    write_text(path, file.content);
    std::string expected = file.command;
    for (auto at = expected.find("DIR"); at != std::string::npos; at = expected.find("DIR"))
      expected.replace(at, 3, folder.path().string());
    const std::string error = error_of(path);
    CHECK(error.starts_with(path.string() + ":1: found "));
    CHECK_CONTAINS(error, file.what);
    CHECK_CONTAINS(error, expected);
    const auto* foreign = io::foreign_format_of(io::Content(file.content), path);
    REQUIRE(foreign != nullptr);
    met.insert(foreign->title);
  }
  CHECK(met.size() == io::foreign_formats().size());  // a file for every row
}

TEST_CASE("content decides whether a file is one of another program") {
  const auto foreign = [](const std::string& content, const char* name) {
    return io::foreign_format_of(io::Content(content), name) != nullptr;
  };
  CHECK_FALSE(foreign("$MeshFormat\n4.1 0 8\n", "a.msh"));
  CHECK_FALSE(foreign("MeshVersionFormatted 2\n", "a.mesh"));
  CHECK_FALSE(foreign("NDIME= 2\n", "a.inp"));
  CHECK_FALSE(foreign("NDIME= 2\n", "a.dat"));
  CHECK_FALSE(foreign(vtk_file("UnstructuredGrid"), "a.vtu"));
  CHECK_FALSE(foreign(hdf5, "a.cgns"));
  CHECK_FALSE(foreign("", "a.bdf"));
  // Names with blanks come as one word of a shell.
  CHECK(io::shell_word("a.msh") == "a.msh");
  CHECK(io::shell_word("my wing.msh") == "'my wing.msh'");
  CHECK(io::shell_word("it's.msh") == "'it'\\''s.msh'");
}

TEST_CASE("elements of second order are refused with the way to elements of first order") {
  const TemporaryFolder folder;
  write_text(folder / "q.msh",
             "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"
             "4 .5 0 0\n5 .5 .5 0\n6 0 .5 0\n$EndNodes\n$Elements\n1\n1 9 2 1 1 1 2 3 4 5 6\n"
             "$EndElements\n");
  const std::string script = (folder / "q_first_order.geo").string();
  CHECK_CONTAINS(error_of(folder / "q.msh"),
                 "echo 'Merge \"q.msh\"; SetOrder 1; Save \"q_first_order.msh\";' > " + script +
                     " && gmsh " + script + " -");
  CHECK_CONTAINS(io::first_order_hint("a/q.vtu"),
                 "meshio convert --output-format gmsh22 a/q.vtu a/q_second_order.msh && ");
  write_text(folder / "q.su2",
             "NDIME= 2\nNELEM= 1\n22 0 1 2 3 4 5\nNPOIN= 6\n0 0\n1 0\n0 1\n.5 0\n.5 .5\n0 .5\n");
  CHECK_CONTAINS(error_of(folder / "q.su2"), "Mesh.ElementOrder = 1");
  write_text(folder / "q.mesh",
             "MeshVersionFormatted 2\nDimension 2\nVertices\n6\n0 0 0\n1 0 0\n0 1 0\n.5 0 0\n"
             ".5 .5 0\n0 .5 0\nTrianglesP2\n1\n1 2 3 4 5 6 1\nEnd\n");
  CHECK_CONTAINS(error_of(folder / "q.mesh"), "second order (TrianglesP2)");
  CHECK_CONTAINS(error_of(folder / "q.mesh"), "Merge \"q.mesh\"; SetOrder 1;");
}

}  // namespace winslow::test
