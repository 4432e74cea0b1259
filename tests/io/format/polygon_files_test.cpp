#include <doctest/doctest.h>

#include "io/format/mesh_format.h"
#include "io/support/mutations.h"
#include "io/support/samples.h"
#include "io/surface/surface.h"
#include "support/polygon_meshes.h"

namespace winslow::test {
namespace {

/// Formats that hold polygons as they are.
std::vector<Kind> polygon_kinds() {
  return {{"vtk", "", false}, {"vtk", "", true},  {"vtu", "", false}, {"vtu", "", true},
          {"obj", "", false}, {"off", "", false}, {"ply", "", false}, {"ply", "", true}};
}

Mesh dual_mesh() {
  Mesh mesh = make_mesh(square_with_hole(10, Cells::triangles));
  Random random(17);
  perturb(mesh, random, 0.2);
  MeshData data = dual_of(mesh);
  const auto shapes = Topology::build(data);
  // As readers have it.
  for (Index e = 0; e < data.element_count(); ++e)
    if (data.element(e).size() == 4 && shapes->shape(e).real_corners == 4)
      data.types[at(e)] = ElementType::quadrilateral;
  return make_mesh(data);
}

/// Triangles with a hanging node, a pentagon and a square: what a face with four corners is, only
/// its corners say.
MeshData hanging_triangle() {
  MeshData data;
  for (const Vec2& p : {Vec2(0, 0), Vec2(2, 0), Vec2(2, 2), Vec2(0, 2), Vec2(1, 0), Vec2(0, -1),
                        Vec2(1, -1), Vec2(2, -1), Vec2(3, 3), Vec2(1, 4)})
    data.coordinates.push_xy(p);
  add_quad(data, 5, 6, 4, 0);
  add_quad(data, 6, 7, 1, 4);
  data.add_element(ElementType::polygon, std::array<Index, 4>{0, 4, 1, 2});
  add_triangle(data, 0, 2, 3);
  data.add_element(ElementType::polygon, std::array<Index, 5>{3, 2, 1, 8, 9});
  return data;
}

std::string as_file(const Mesh& mesh, const Kind& kind) {
  const TemporaryFolder folder;
  const auto path = folder / ("a." + std::string(kind.extension));
  io::write_mesh(path, mesh, nullptr, options_of(kind));
  return read_text(path);
}

}  // namespace

TEST_CASE("meshes of polygons come back from every format that holds them") {
  for (const Mesh& mesh :
       {dual_mesh(), make_mesh(quadtree_with_hole(10)), make_mesh(hanging_triangle())}) {
    for (const Kind& kind : polygon_kinds()) {
      CAPTURE(text_of(kind));
      const bool markers =
          io::format_of_extension("x." + std::string(kind.extension))->keeps_markers;
      Comparison plain;
      plain.markers = markers && mesh.topology->markers().from_file();
      const std::string name = "a." + std::string(kind.extension);
      const io::MeshFile file = read_from_text(name, as_file(mesh, kind));
      check_same_mesh(file.mesh, mesh, plain);
      CHECK(
          std::ranges::equal(file.mesh.topology->element_types(), mesh.topology->element_types()));
      CHECK(check_validity(*file.mesh.topology, file.mesh.coordinates).inverted == 0);
      // Written again, the file has the same bytes.
      CHECK(as_file(file.mesh, kind) == as_file(mesh, kind));
    }
  }
}

TEST_CASE(
    "polygons with three corners, or four that are not flat, are triangles and quadrilaterals") {
  const std::string vtk =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
      "0 0 0 1 0 0 2 0 0 2 2 0 0 2 0 -2 1 0\nCELLS 2 9\n3 0 4 5\n4 0 2 3 4\nCELL_TYPES 2\n7\n7\n";
  const io::MeshFile plain = read_from_text("a.vtk", vtk);
  CHECK(plain.mesh.topology->element_type(0) == ElementType::triangle);
  CHECK(plain.mesh.topology->element_type(1) == ElementType::quadrilateral);
  CHECK_FALSE(plain.mesh.topology->has_polygons());
  // The same quadrilateral as a triangle with a node in its side, clockwise.
  const io::MeshFile flat = read_from_text("a.vtk", replaced(vtk, "4 0 2 3 4", "4 4 2 1 0"));
  CHECK(flat.mesh.topology->element_type(1) == ElementType::polygon);
  CHECK(check_validity(*flat.mesh.topology, flat.mesh.coordinates).inverted == 0);
  // A quadrilateral (9) stays one, as tangled as it is.
  const io::MeshFile given =
      read_from_text("a.vtk", replaced(replaced(vtk, "4 0 2 3 4", "4 4 2 1 0"), "7\n7", "7\n9"));
  CHECK(given.mesh.topology->element_type(1) == ElementType::quadrilateral);
}

TEST_CASE("a file of polygons that has moved keeps its cells") {
  const TemporaryFolder folder;
  const Mesh mesh = dual_mesh();
  io::write_mesh(folder / "a.vtu", mesh, nullptr);
  io::MeshFile file = io::read_mesh(folder / "a.vtu");
  file.mesh.coordinates.set_xy(0, file.mesh.coordinates.xy(0) + Vec2(1e-3, 0));
  io::write_mesh(folder / "b.vtu", file.mesh, file.details.get());
  const io::MeshFile moved = io::read_mesh(folder / "b.vtu");
  check_same_mesh(moved.mesh, file.mesh);
}

TEST_CASE("formats without polygons refuse them by name, with their number") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(hanging_triangle());
  for (const char* extension : {"su2", "msh", "mesh", "cgns"}) {
    const io::MeshFormat* format = io::format_of_extension("a." + std::string(extension));
    if (!format->missing.empty()) continue;
    const auto path = folder / ("a." + std::string(extension));
    try {
      io::write_mesh(path, mesh, nullptr);
      FAIL("written");
    } catch (const UsageError& error) {
      CHECK_CONTAINS(error.what(), "files cannot hold the 2 polygons of this mesh of 5 elements");
      CHECK_CONTAINS(error.what(), "formats that can: ");
      CHECK_CONTAINS(error.what(), "(vtu)");
    }
    CHECK_FALSE(std::filesystem::exists(path));
  }
}

TEST_CASE("STL: polygons are cut into triangles of the same area") {
  const Mesh mesh = dual_mesh();
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.stl", mesh, nullptr);
  const io::MeshFile cut = io::read_mesh(folder / "a.stl");
  const auto sum = [](const Mesh& of) {
    double area = 0;
    for (Index e = 0; e < of.topology->element_count(); ++e)
      area += signed_area2(of.coordinates, of.topology->element(e)) / 2;
    return area;
  };
  CHECK(sum(cut.mesh) == doctest::Approx(sum(mesh)));
  CHECK(cut.mesh.topology->element_count() == io::written_counts("a.stl", mesh, nullptr).elements);
  CHECK(cut.mesh.topology->face_count() > mesh.topology->face_count());
}

TEST_CASE("polygons of surfaces are refused with their number and the way out") {
  const Mesh mesh = dual_mesh();
  std::string text = as_file(mesh, {"obj", "", false});
  const std::size_t line = text.find('\n', text.find('\n') + 1);
  const std::size_t end = text.find('\n', line + 1);
  text.replace(text.rfind(' ', end), end - text.rfind(' ', end), " 0.25");
  const std::string error = input_error("a.obj", text);
  CHECK_CONTAINS(error, " elements are polygons)");
  CHECK_CONTAINS(error, "cut its polygons into triangles first");
}

TEST_CASE("polygons with too many corners are refused where they are") {
  std::string text = "v 0 0 0\n", face = "f 1";
  for (int k = 2; k <= 1001; ++k) {
    const double angle = 6.28 * k / 1001;
    text += "v " + std::to_string(std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + " 0\n";
    face += ' ' + std::to_string(k);
  }
  CHECK_CONTAINS(input_error("a.obj", text + face + '\n'),
                 "a.obj:1002: found a face with 1001 corners, expected 3 to 1000");
}

TEST_CASE("--repair mends meshes of polygons") {
  const TemporaryFolder folder;
  // Two points in one place, between a pentagon and a square.
  write_text(folder / "a.obj",
             "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nv 2 0 0\nv 4 0 0\nv 4 2 0\n"
             "f 1 2 3 4 5\nf 6 7 8 3\n");
  const io::MeshFile mended = io::read_mesh(folder / "a.obj", {.defects = io::Defects::repair});
  CHECK(mended.mesh.topology->element_count() == 2);
  CHECK(mended.mesh.topology->node_count() == 7);
  CHECK(mended.mesh.topology->element_type(0) == ElementType::polygon);
  CHECK(mended.mesh.topology->element_type(1) == ElementType::quadrilateral);
}

TEST_CASE("OpenFOAM: a mesh of prisms over polygons, one cell thick, is a plane mesh") {
  const TemporaryFolder folder;
  const Mesh mesh = dual_mesh();
  io::write_mesh(folder / "polyMesh", mesh, nullptr);
  const io::MeshFile back = io::read_mesh(folder / "polyMesh");
  REQUIRE(back.mesh.topology->kind() == MeshKind::plane);
  CHECK(back.mesh.coordinates == mesh.coordinates);
  CHECK(std::ranges::equal(back.mesh.topology->element_types(), mesh.topology->element_types()));
  CHECK(check_validity(*back.mesh.topology, back.mesh.coordinates).inverted == 0);
}

TEST_CASE("no damaged file of polygons does anything but give a mesh or an InputError") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(dual_of(make_mesh(square(2, Cells::mixed))));
  int meshes = 0, refused = 0;
  for (const Kind& kind : polygon_kinds()) {
    const std::string original = as_file(mesh, kind);
    const auto path = folder / ("a." + std::string(kind.extension));
    for (std::uint64_t seed = 0; seed < mutation_count(200); ++seed) {
      CAPTURE(text_of(kind));
      CAPTURE(seed);
      Random random(seed);
      write_text(path, mutated(original, random));
      const auto again = folder / ("again." + std::string(kind.extension));
      ++(survives(path, path, again) ? meshes : refused);
    }
  }
  MESSAGE(meshes, " meshes, ", refused, " refused");
  CHECK(meshes > 50);
  CHECK(refused > 300);
}

}  // namespace winslow::test
