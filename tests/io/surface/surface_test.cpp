#include <Eigen/Geometry>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>

#include "io/format/mesh_format.h"
#include "io/support/samples.h"
#include "io/support/volume_samples.h"
#include "io/surface/surface.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

using OpenMeshPolygons = OpenMesh::PolyMesh_ArrayKernelT<>;

std::string data(const char* name) { return read_text(test::test_data(name)); }

}  // namespace

TEST_CASE("OBJ, OFF, PLY: the elements of the SU2 file; STL: its triangles") {
  const io::MeshFile expected = io::read_mesh(test::test_data("square.su2"));
  Comparison plain;
  plain.markers = false;
  for (const char* name : {"square.obj", "square.off", "square.ply", "square_b.ply"}) {
    CAPTURE(name);
    const io::MeshFile file = io::read_mesh(test::test_data(name));
    check_same_mesh(file.mesh, expected.mesh, plain);
    CHECK_FALSE(file.mesh.topology->markers().from_file());
  }
  for (const char* name : {"square.stl", "square_b.stl"}) {
    const io::MeshFile file = io::read_mesh(test::test_data(name));
    CHECK(file.mesh.topology->element_count() == 8);
    CHECK(file.mesh.coordinates.size() == 9);
  }
}

TEST_CASE("OpenMesh reads what we write, and we read what OpenMesh writes") {
  const io::MeshFile square = io::read_mesh(test::test_data("square.su2"));
  const TemporaryFolder folder;
  for (const Kind& kind : kinds()) {
    if (io::format_of_extension("x." + std::string(kind.extension))->keeps_markers) continue;
    CAPTURE(text_of(kind));
    const std::string extension = kind.extension;
    const bool stl = extension == "stl";
    const auto ours = folder / ("ours." + extension);
    io::write_mesh(ours, square.mesh, nullptr, options_of(kind));
    OpenMeshPolygons mesh;
    OpenMesh::IO::Options options;
    if (kind.binary) options += OpenMesh::IO::Options::Binary;
    REQUIRE(OpenMesh::IO::read_mesh(mesh, ours.string(), options));
    CHECK(mesh.n_vertices() == 9);
    CHECK(mesh.n_faces() == (stl ? 8U : 6U));

    const auto theirs = folder / ("theirs." + extension);
    OpenMesh::IO::Options out;
    if (kind.binary) out += OpenMesh::IO::Options::Binary;
    REQUIRE(OpenMesh::IO::write_mesh(mesh, theirs.string(), out, 17));
    const io::MeshFile back = io::read_mesh(theirs);
    CHECK(back.mesh.coordinates.size() == 9);
    CHECK(back.mesh.topology->element_count() == (stl ? 8 : 6));
    if (!stl) CHECK(back.mesh.coordinates == square.mesh.coordinates);
  }
}

TEST_CASE("OBJ: references of every form, comments, other keywords") {
  const io::MeshFile file = read_from_text(
      "a.obj",
      "# square\nmtllib none\no it\nv 0 0 0\nv 1 0 0 1\nvt 0 0\nvn 0 0 1\nv 1 1 0\nv 0 1 0\ns off\n"
      "f 1/1 2/1/1 3//1\nf -4 -2 -1 # the other half\nl 1 2\n");
  CHECK(file.mesh.topology->element_count() == 2);
  CHECK(any_contains(file.warnings, "line elements are not kept"));
}

TEST_CASE("surfaces: what a mesh does not hold is said, once each") {
  const std::string faces = "f 1 2 3\nf 1 3 4\n", head = "v 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto obj = read_from_text(
      "a.obj", "g left\nv 0 0 0 0.5 0.5 0.5\n" + head + "usemtl red\ng right\n" + faces);
  CHECK(any_contains(obj.warnings, "groups of the file are not kept"));
  CHECK(any_contains(obj.warnings, "colours of the file are not kept"));
  CHECK(any_contains(obj.warnings, "materials of the file are not kept"));
  CHECK(obj.warnings.size() == 3);
  CHECK(read_from_text("a.obj", "v 0 0 0 1\n" + head + faces).warnings.empty());

  const auto off = read_from_text(
      "a.off", "COFF\n3 1 0\n0 0 0 9 9 9 9\n1 0 0 9 9 9 9\n0 1 0 9 9 9 9\n3 0 1 2\n");
  CHECK(any_contains(off.warnings, "colours of the file are not kept"));
  const auto ply = read_from_text(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty float quality\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 1 1\n1 0 0 1 1\n0 1 0 1 1\n"
      "3 0 1 2\n");
  CHECK(any_contains(ply.warnings, "colours of the file are not kept"));
  CHECK(any_contains(ply.warnings, "property 'quality' and its values of the file are not kept"));
  CHECK(ply.warnings.size() == 2);
}

TEST_CASE("OBJ: bad input is refused with file and line") {
  const std::string text = data("square.obj");
  const auto error = [&](const std::string& part, const std::string& by) {
    return input_error("a.obj", replaced(text, part, by));
  };
  CHECK_CONTAINS(error("f 6 9 8", "f 6 10 8"), "a.obj:15: element 5 uses node 9, expected 0 to 8");
  CHECK_CONTAINS(error("f 6 9 8", "f 6 0 8"),
                 "a.obj:15: found '0', expected the number of a vertex");
  CHECK_CONTAINS(error("f 6 9 8", "f 6 -10 8"), "a.obj:15: found '-10'");
  CHECK_CONTAINS(error("f 6 9 8", "f 6 9"), "a.obj:15: found a face with 2 corners");
  CHECK_CONTAINS(error("f 6 9 8", "f 6 9 8 7 1"), "a.obj:");
  CHECK_CONTAINS(error("v 1 0.5 0", "v 1 0.5"), "a.obj:6: found the end of the line");
  CHECK_CONTAINS(error("v 1 0.5 0", "v 1 nan 0"), "a.obj:6: found nan");
  CHECK(
      is_surface(*read_from_text("a.obj", replaced(text, "v 1 0.5 0", "v 1 0.5 2")).mesh.topology));
  CHECK_CONTAINS(error("v 1 0.5 0", "w 1 0.5 0"), "a.obj:6: found 'w'");
  CHECK_CONTAINS(input_error("a.obj", text.substr(0, text.find("f "))), "found no faces");
}

TEST_CASE("OFF: bad input is refused with file and line; comments and colours are accepted") {
  const std::string text = data("square.off");
  const auto error = [&](const std::string& part, const std::string& by) {
    return input_error("a.off", replaced(text, part, by));
  };
  CHECK_CONTAINS(error("9 6 0", "10 6 0"),
                 "a.off:17: found the end of the file, expected face 6 of 6");
  CHECK_CONTAINS(error("9 6 0", "9 7 0"),
                 "a.off:17: found the end of the file, expected face 7 of 7");
  CHECK_CONTAINS(error("9 6 0", "9 5 0"), "a.off:17: found '3', expected the end of the file");
  CHECK_CONTAINS(error("9 6 0", "9000000000 6 0"), "a.off:2: found 9000000000");
  CHECK_CONTAINS(error("3 5 8 7", "3 5 9 7"), "a.off:17: element 5 uses node 9");
  CHECK_CONTAINS(error("3 5 8 7", "2 5 8"), "a.off:17: found a face with 2 corners");
  CHECK_CONTAINS(error("3 5 8 7", "3 5 8"), "a.off:17: found the end of the");
  CHECK_CONTAINS(error("1 0.5 0", "1 nan 0"), "a.off:8: found nan");
  CHECK_CONTAINS(error("OFF\n", "OFF BINARY\n"), "found a binary OFF file");
  const io::MeshFile file = read_from_text(
      "a.off",
      "COFF\n# four\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 0 0 0 0\n1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n\n"
      "3 0 1 2 9 9 9\n# last\n3 0 2 3\n");
  CHECK(file.mesh.topology->element_count() == 2);
}

TEST_CASE("PLY: properties in any order, extra elements, big-endian; bad input is refused") {
  const std::string text = data("square.ply");
  const auto error = [&](const std::string& part, const std::string& by) {
    return input_error("a.ply", replaced(text, part, by));
  };
  const std::string odd =
      "ply\nformat ascii 1.0\ncomment odd\nelement material 1\nproperty list uchar float c\n"
      "element vertex 4\nproperty float nx\nproperty float y\nproperty double x\n"
      "element face 2\nproperty uchar flag\nproperty list uint8 int32 vertex_index\nend_header\n"
      "2 0.5 0.5\n9 0 0\n9 0 1\n9 1 1\n9 1 0\n7 3 0 1 2\n7 3 0 2 3\n";
  const io::MeshFile file = read_from_text("a.ply", odd);
  CHECK(file.mesh.coordinates.xy(1) == Vec2(1, 0));
  CHECK(file.mesh.topology->element_count() == 2);

  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nelement face 1\nproperty list uchar short vertex_indices\n"
      "end_header\n";
  const auto put = [&](const char* bytes, std::size_t n) { big.append(bytes, n); };
  for (int i = 0; i < 3; ++i) {
    put(i == 1 ? "\x3f\x80\0\0" : "\0\0\0\0", 4);
    put(i == 2 ? "\x3f\x80\0\0" : "\0\0\0\0", 4);
  }
  put("\3\0\0\0\1\0\2", 7);
  CHECK(read_from_text("a.ply", big).mesh.coordinates.xy(2) == Vec2(0, 1));
  CHECK_CONTAINS(input_error("a.ply", big.substr(0, big.size() - 1)), "the end of the file");
  CHECK_CONTAINS(input_error("a.ply", replaced(big, "big", "little")), "a.ply: byte ");

  CHECK_CONTAINS(error("vertex 9", "vertex 10"), "a.ply:19: found '4'");
  CHECK(
      contains(error("face 6", "face 7"), "a.ply:24: found the end of the file, expected face 7"));
  CHECK_CONTAINS(error("vertex 9", "vertex 2000000000"), "a.ply:3: found 2000000000");
  CHECK_CONTAINS(error("3 5 8 7", "3 5 -8 7"), "a.ply:24: found -8");
  CHECK_CONTAINS(error("3 5 8 7", "2000000000 5 8 7"), "a.ply:24: found a face with 2000000000");
  CHECK_CONTAINS(error("3 5 8 7", "3 5 9 7"), "a.ply:24: element 5 uses node 9");
  CHECK_CONTAINS(error("1 0.5 0", "1 nan 0"), "a.ply:15: found nan");
  CHECK_CONTAINS(error("format ascii 1.0\n", ""), "found no line \"format\"");
  CHECK_CONTAINS(error("ascii", "utf8"), "a.ply:2: found 'utf8'");
  CHECK_CONTAINS(error("double x", "quad x"), "a.ply:4: found 'quad'");
  CHECK_CONTAINS(error("end_header", "the_end"), "found 'the_end'");
}

TEST_CASE("STL: bad input is refused with line or byte") {
  const std::string text = data("square.stl");
  CHECK_CONTAINS(input_error("a.stl", replaced(text, "vertex 0.5 0 0", "vertex 0.5 0")),
                 "a.stl:5: found the end of the line");
  CHECK_CONTAINS(input_error("a.stl", replaced(text, "vertex 0.5 0 0", "vertex nan 0 0")),
                 "a.stl:5: found nan");
  CHECK_CONTAINS(input_error("a.stl", replaced(text, "endloop", "end")), "a.stl:7: found 'end'");
  CHECK_CONTAINS(input_error("a.stl", text.substr(0, text.size() / 2)),
                 "a.stl:30: found 'f', expected facet");
  std::string binary = data("square_b.stl");
  CHECK_CONTAINS(input_error("a.stl", binary.substr(0, binary.size() - 3)),
                 "a.stl: byte 80: found 8 as the number of facets, expected at most 7");
  const std::uint32_t huge = 0xffffffff;
  std::memcpy(binary.data() + 80, &huge, sizeof huge);
  CHECK_CONTAINS(input_error("a.stl", binary), "a.stl: byte 80: found 4294967295");
}

namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Volume inside the triangles of an ASCII STL file; checks their normals.
double enclosed_volume(const std::string& stl) {
  std::istringstream in(stl);
  double volume = 0;
  Vec3 normal;
  std::vector<Vec3> corners;
  for (std::string word; in >> word;) {
    if (word == "normal") in >> normal[0] >> normal[1] >> normal[2];
    if (word != "vertex") continue;
    Vec3& p = corners.emplace_back();
    in >> p[0] >> p[1] >> p[2];
    if (corners.size() < 3) continue;
    const Vec3 area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    CHECK(area.normalized().isApprox(normal, 1e-12));
    volume += corners[0].dot(area) / 6;
    corners.clear();
  }
  return volume;
}

}  // namespace

TEST_CASE("the boundary of a volume mesh in STL: closed, outwards, a solid for each marker") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(4, volumes));
    const TemporaryFolder folder;
    const auto warnings = io::write_mesh(folder / "a.stl", mesh, nullptr);
    CHECK(any_contains(warnings, "only the boundary is written"));
    CHECK_FALSE(any_contains(warnings, "markers"));
    const std::string text = read_text(folder / "a.stl");
    CHECK(enclosed_volume(text) == doctest::Approx(1).epsilon(1e-12));
    for (const char* name : {"solid floor\n", "solid lid\n", "solid walls\n"})
      CHECK(count_of(text, name) == 2);  // solid, endsolid
    CHECK(count_of(text, "facet normal") == 6 * 16 * 2);
  }
}

TEST_CASE("the boundary of a volume mesh in OBJ, OFF and PLY: its nodes and no others") {
  const Mesh mesh = make_mesh(cube(3, Volumes::hexahedra));
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.obj", mesh, nullptr);
  const std::string obj = read_text(folder / "a.obj");
  CHECK(count_of(obj, "v ") == 56);
  CHECK(count_of(obj, "f ") == 54);
  CHECK_CONTAINS(obj, "\ng walls\n");
  CHECK(any_contains(io::write_mesh(folder / "a.off", mesh, nullptr), "markers: they are lost"));
  CHECK_CONTAINS(read_text(folder / "a.off"), "OFF\n56 54 0\n");
  io::write_mesh(folder / "a.ply", mesh, nullptr);
  CHECK_CONTAINS(read_text(folder / "a.ply"), "element face 54\n");
}

TEST_CASE("boundary faces in no marker are a group of their own") {
  MeshData data = cube(1, Volumes::tetrahedra);
  data.markers.erase(data.markers.begin());
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.obj", make_mesh(data), nullptr);
  const std::string obj = read_text(folder / "a.obj");
  CHECK(obj.find("g boundary\n") > obj.find("g walls\n"));
  CHECK(count_of(obj, "f ") == 12);
}

namespace {

std::string facet(const char* a, const char* b, const char* c) {
  std::string text = "facet normal 0 0 1\nouter loop\n";
  for (const char* p : {a, b, c}) text += std::string("vertex ") + p + '\n';
  return text + "endloop\nendfacet\n";
}

std::vector<std::string> region_names(const io::MeshFile& file) {
  std::vector<std::string> names;
  for (const Region& region : file.mesh.topology->regions()) names.push_back(region.name);
  return names;
}

}  // namespace

TEST_CASE("STL of several solids: all are read, their names are regions and go back") {
  const std::string text = "solid left wing\n" + facet("0 0 0", "1 0 0", "0 1 0") +
                           "endsolid left wing\nsolid right\n" + facet("1 0 0", "1 1 0", "0 1 0") +
                           "endsolid right\nsolid left wing\n" +
                           facet("0 1 0", "1 1 0", "0.5 2 1") + "endsolid\n";
  const io::MeshFile file = read_from_text("a.stl", text);
  CHECK(file.mesh.topology->element_count() == 3);
  CHECK(file.mesh.topology->node_count() == 5);
  CHECK(region_names(file) == std::vector<std::string>{"left wing", "right"});
  CHECK(std::ranges::equal(file.mesh.topology->element_regions(), std::array<Index, 3>{0, 1, 0}));
  const TemporaryFolder folder;
  // One solid for each name: the order of the facets changes, and that is said.
  CHECK(any_contains(io::write_mesh(folder / "b.stl", file.mesh, file.details.get()),
                     "their order has changed"));
  const io::MeshFile back = io::read_mesh(folder / "b.stl");
  CHECK(region_names(back) == region_names(file));
  CHECK(back.mesh.topology->element_count() == 3);
  io::WriteOptions binary;
  binary.binary = true;
  CHECK(any_contains(io::write_mesh(folder / "c.stl", file.mesh, nullptr, binary),
                     "the names of element sets are lost"));
  // One solid alone is the whole mesh, no region.
  CHECK(read_from_text("a.stl", "solid one\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid\n")
            .mesh.topology->regions()
            .empty());
  CHECK_CONTAINS(input_error("a.stl", text + "solids\n"),
                 "a.stl:28: found 'solids', expected solid");
}

TEST_CASE("STL: what winslow writes of a volume mesh is read, markers as regions") {
  const Mesh mesh = make_mesh(cube(2, Volumes::hexahedra));
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.stl", mesh, nullptr);
  const io::MeshFile file = io::read_mesh(folder / "a.stl");
  std::vector<std::string> markers;
  for (const Marker& marker : mesh.topology->markers()) markers.push_back(marker.name);
  CHECK(markers.size() > 1);
  CHECK(region_names(file) == markers);
  CHECK(file.mesh.topology->element_count() == 48);
  CHECK(file.mesh.topology->boundary_loops().empty());
}

TEST_CASE("STL: text in capitals") {
  std::string text = "solid A\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid A\n";
  for (char& c : text) c = static_cast<char>(std::toupper(c));
  CHECK(read_from_text("a.stl", text).mesh.topology->element_count() == 1);
  CHECK(read_from_text("a.xyz", text).format->name == "stl");
}

TEST_CASE("STL: facets with two corners in one place are left out, with the place of the first") {
  const std::string text = "solid\n" + facet("0 0 0", "1 0 0", "0 1 0") +
                           facet("1 0 0", "1 0 0", "0 1 0") + facet("1 0 0", "1 1 0", "0 1 0") +
                           facet("5 5 5", "5 5 5", "5 5 5") + "endsolid\n";
  const io::MeshFile file = read_from_text("a.stl", text);
  CHECK(file.mesh.topology->element_count() == 2);
  CHECK(file.mesh.topology->node_count() == 4);
  REQUIRE(file.warnings.size() >= 1);
  CHECK_CONTAINS(file.warnings[0],
                 "2 facets have two corners in one place, the first at line 9: left out");
}

TEST_CASE("binary STL: colours and bytes behind the facets are said to be lost") {
  const std::string plain = data("square_b.stl");
  CHECK(read_from_text("a.stl", plain).warnings.size() ==
        io::read_mesh(test_data("square_b.stl")).warnings.size());
  std::string coloured = plain;
  coloured[84 + 48] = 31;
  CHECK(
      any_contains(read_from_text("a.stl", coloured).warnings, "colours of the file are not kept"));
  std::string header = plain;
  header.replace(0, 10, "COLOR=abcd");
  CHECK(any_contains(read_from_text("a.stl", header).warnings, "colours of the file are not kept"));
  // Two bytes behind the facets, also under a header that begins as text does.
  for (const char* start : {"", "solid cube"}) {
    std::string longer = plain + "\r\n";
    longer.replace(0, std::string(start).size(), start);
    const io::MeshFile file = read_from_text("a.stl", longer);
    CHECK(file.mesh.topology->element_count() == 8);
    CHECK(any_contains(file.warnings, "2 bytes behind the 8 facets are not kept"));
  }
}

TEST_CASE("OBJ: statements that go on behind a backslash") {
  const std::string text =
      "# folder C:\\meshes\\\nv 0 \\\n 0 0\nv 1 0 0\nv 1 1 \\\r\n0\nv 0 1 0\n"
      "f 1 2 \\\n\\\n 3\\\n 4\ng one \\\n two\n";
  const io::MeshFile file = read_from_text("a.obj", text);
  CHECK(file.mesh.topology->node_count() == 4);
  CHECK(file.mesh.topology->element_type(0) == ElementType::quadrilateral);
  CHECK(file.mesh.coordinates.xy(2) == Vec2(1, 1));
  CHECK_CONTAINS(input_error("a.obj", "v 0 0 \\\n x\n"), "a.obj:2: found 'x'");
  CHECK_CONTAINS(input_error("a.obj", "v 0 0 \\"), "a.obj:1: found the end");
}

TEST_CASE("counts are those of the file that is written") {
  const Mesh volume = make_mesh(cube(2, Volumes::hexahedra));
  const auto counts = [](const char* name, const Mesh& mesh) {
    const io::MeshCounts found = io::written_counts(name, mesh, nullptr);
    return std::array{static_cast<std::size_t>(found.nodes),
                      static_cast<std::size_t>(found.elements), found.markers};
  };
  const std::size_t markers = volume.topology->markers().size();
  CHECK(counts("a.su2", volume) == std::array<std::size_t, 3>{27, 8, markers});
  CHECK(counts("a.obj.gz", volume) == std::array<std::size_t, 3>{26, 24, 0});
  CHECK(counts("a.stl", volume) == std::array<std::size_t, 3>{26, 48, 0});
  MeshData data = square(2, Cells::quads);
  data.markers.clear();
  const Mesh plane = make_mesh(data);
  CHECK(counts("a.ply", plane) == std::array<std::size_t, 3>{9, 4, 0});
  CHECK_FALSE(plane.topology->markers().empty());  // made of the boundary, and not written
  CHECK(counts("a.su2", plane)[2] == 0);
}

}  // namespace winslow::test
