#include <set>
#include <sstream>

#include "core/quality/quality.h"
#include "io/file/atomic_file.h"

#include "io/support/openfoam_cases.h"
#include "io/support/volume_samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

namespace fs = std::filesystem;

const std::string &points = cube_points, &faces = cube_faces, &boundary = cube_boundary;

std::string error_of(const std::string& file, const std::string& part, const std::string& by) {
  const TemporaryFolder folder;
  const auto changed = [&](const char* name, const std::string& text) {
    return file == name ? replaced(text, part, by) : text;
  };
  const fs::path mesh = write_cube_case(folder.path(), changed("points", points),
                                        changed("faces", faces), changed("boundary", boundary));
  try {
    io::read_mesh(mesh);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(mesh.string().size() + 1);
  }
  return "no error";
}

std::set<Index> node_set(std::span<const Index> nodes) { return {nodes.begin(), nodes.end()}; }

/// Cells have no first corner in OpenFOAM, and faces of patches are seen from outside.
void check_same_cells(const Mesh& a, const Mesh& b) {
  CHECK(a.coordinates == b.coordinates);
  REQUIRE(a.topology->element_count() == b.topology->element_count());
  for (Index e = 0; e < a.topology->element_count(); ++e) {
    CHECK(a.topology->element_type(e) == b.topology->element_type(e));
    CHECK(node_set(a.topology->element(e)) == node_set(b.topology->element(e)));
  }
  REQUIRE(a.topology->markers().size() == b.topology->markers().size());
  for (std::size_t m = 0; m < a.topology->markers().size(); ++m) {
    const Marker& p = a.topology->markers()[m];
    const Marker& q = b.topology->markers()[m];
    CHECK(p.name == q.name);
    REQUIRE(p.faces.size() == q.faces.size());
    for (std::size_t f = 0; f < p.faces.size(); ++f) {
      CHECK(p.faces[f].sorted() == q.faces[f].sorted());
      CHECK(p.faces[f][0] == q.faces[f][0]);
    }
  }
}

}  // namespace

TEST_CASE("OpenFOAM: a case, its folder, and a file .foam in it are the same mesh") {
  const TemporaryFolder folder;
  const fs::path mesh = write_cube_case(folder.path());
  write_text(folder / "cube.foam", "");
  for (const fs::path& path : {mesh, folder.path(), folder / "cube.foam", folder / "constant"}) {
    CAPTURE(path);
    const io::MeshFile file = io::read_mesh(path);
    CHECK(file.warnings.empty());
    const Topology& topology = *file.mesh.topology;
    REQUIRE(topology.element_count() == 1);
    CHECK(topology.element_type(0) == ElementType::hexahedron);
    REQUIRE(topology.markers().size() == 3);
    CHECK(topology.markers()[1].name == "outlet");
    CHECK(topology.markers()[1].faces[0] == Face(1, 3, 7, 5));
    CHECK(topology.markers()[2].faces.size() == 4);
  }
}

TEST_CASE("OpenFOAM: older files list faces of the boundary among the neighbours") {
  const TemporaryFolder folder;
  const fs::path mesh = write_cube_case(folder.path());
  for (const char* neighbours : {"6(-1 -1 -1 -1 -1 -1)", "6{-1}"}) {
    write_text(mesh / "neighbour", neighbours);
    CHECK(io::read_mesh(mesh).mesh.topology->element_count() == 1);
  }
  write_text(mesh / "neighbour", "6(-1 -1 0 -1 -1 -1)");
  CHECK_THROWS_WITH_AS(io::read_mesh(mesh),
                       (mesh.string() + "/neighbour:1: found no neighbour of face 0 and one of a "
                                        "later face, expected the faces of the boundary last")
                           .c_str(),
                       InputError);
  write_text(mesh / "owner", "6(0 0 -1 0 0 0)");
  CHECK_THROWS_AS(io::read_mesh(mesh), InputError);
}

TEST_CASE("OpenFOAM: a list of patches may have no number before it") {
  const TemporaryFolder folder;
  const fs::path mesh = write_cube_case(folder.path());
  write_text(mesh / "boundary", boundary.substr(boundary.find('(')));
  CHECK(io::read_mesh(mesh).mesh.topology->markers().size() == 3);
  write_text(mesh / "boundary", "( inlet { type patch; nFaces 1; startFace 0; }");
  CHECK_THROWS_AS(io::read_mesh(mesh), InputError);
}

TEST_CASE("OpenFOAM: while nodes only move, all but their places stays as it is") {
  const TemporaryFolder folder;
  const fs::path mesh = write_cube_case(folder.path());
  io::MeshFile file = io::read_mesh(mesh);
  file.mesh.coordinates.set_xyz(7, {1.25, 1, 1});
  CHECK(io::write_mesh(mesh, file.mesh, file.details.get()).empty());
  CHECK(read_text(mesh / "points") == replaced(points, "(1 1 1)", "(1.25 1 1)"));
  CHECK(read_text(mesh / "faces") == faces);
  CHECK(read_text(mesh / "boundary") == boundary);
}

TEST_CASE("OpenFOAM: cells of every type, patches and places come back; faces are in order") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    Random random(8);
    const Mesh mesh = make_mesh(volume_sample(random, volumes, false));
    const TemporaryFolder folder;
    CHECK(io::write_mesh(folder / "constant/polyMesh", mesh, nullptr).empty());
    const io::MeshFile file = io::read_mesh(folder / "cube.foam");
    CHECK(file.warnings.empty());
    check_same_cells(file.mesh, mesh);
    const std::string first = read_text(folder / "constant/polyMesh/faces");
    const std::string owner = read_text(folder / "constant/polyMesh/owner");
    // Written anew, not from the texts of the source: the same order again.
    io::write_mesh(folder / "constant/polyMesh", file.mesh, nullptr);
    CHECK(read_text(folder / "constant/polyMesh/owner") == owner);
    CHECK(read_text(folder / "constant/polyMesh/faces").size() == first.size());
  }
}

TEST_CASE("OpenFOAM: faces between cells are in upper triangular order") {
  Random random(2);
  const Mesh mesh = make_mesh(volume_sample(random, Volumes::mixed, false));
  const TemporaryFolder folder;
  io::write_mesh(folder / "polyMesh", mesh, nullptr);
  const auto labels = [&](const char* name) {
    std::istringstream in(read_text(folder / ("polyMesh/" + std::string(name))));
    std::string line;
    while (std::getline(in, line) && line != "(") {
    }
    std::vector<int> list;
    for (int label = 0; in >> label;) list.push_back(label);
    return list;
  };
  const auto owner = labels("owner"), neighbour = labels("neighbour");
  REQUIRE(neighbour.size() > 100);
  for (std::size_t f = 0; f < neighbour.size(); ++f) {
    CHECK(owner[f] < neighbour[f]);
    if (f > 0) CHECK(std::pair(owner[f - 1], neighbour[f - 1]) < std::pair(owner[f], neighbour[f]));
  }
}

TEST_CASE("OpenFOAM: compressed files stay so, and never two of one kind") {
  Random random(2);
  const Mesh mesh = make_mesh(volume_sample(random, Volumes::prisms, true));
  const TemporaryFolder folder;
  const auto warnings = io::write_mesh(folder / "polyMesh", mesh, nullptr);
  CHECK(any_contains(warnings, "cell zones are not written"));
  const fs::path packed = folder / "packed/polyMesh";
  fs::create_directories(packed);
  for (const char* name : {"points", "faces", "owner", "neighbour", "boundary"}) {
    const fs::path target = packed / (std::string(name) + ".gz");
    io::write_atomically(target, [&](std::ostream& out) {
      out << read_text(folder / ("polyMesh/" + std::string(name)));
    });
  }
  const io::MeshFile file = io::read_mesh(packed);
  CHECK(file.mesh.coordinates == mesh.coordinates);
  write_text(packed / "points", "old");
  io::write_mesh(packed, file.mesh, file.details.get());
  CHECK_FALSE(fs::exists(packed / "points"));
  CHECK(io::read_mesh(packed).mesh.coordinates == mesh.coordinates);
}

namespace {

template <class Number>
std::string raw(const std::vector<Number>& values, bool big_endian) {
  std::string bytes;
  for (Number value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (big_endian) std::reverse(one.begin(), one.end());
    bytes += one;
  }
  return '(' + bytes + ')';
}

/// The cube in binary.
template <class Label, class Scalar>
fs::path write_binary_cube(const fs::path& root, bool big_endian) {
  const fs::path mesh = write_cube_case(root);
  const auto head = [&](const char* type) {
    return std::string("FoamFile { version 2.0; format binary; class ") + type + "; arch \"" +
           (big_endian ? "MSB" : "LSB") + ";label=" + std::to_string(8 * sizeof(Label)) +
           ";scalar=" + std::to_string(8 * sizeof(Scalar)) + "\"; }\n\n";
  };
  std::vector<Scalar> xyz;
  for (int i = 0; i < 8; ++i)
    for (const int k : {0, 1, 2}) xyz.push_back(static_cast<Scalar>((i >> k) & 1));
  write_text(mesh / "points", head("vectorField") + "8\n" + raw(xyz, big_endian) + "\n\n// end\n");
  write_text(mesh / "faces", head("faceCompactList") + "7\n" +
                                 raw<Label>({0, 4, 8, 12, 16, 20, 24}, big_endian) + "\n\n24\n" +
                                 raw<Label>({0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4,
                                             2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6},
                                            big_endian) +
                                 "\n");
  write_text(mesh / "owner",
             head("labelList") + "6\n" + raw<Label>({0, 0, 0, 0, 0, 0}, big_endian) + "\n");
  write_text(mesh / "neighbour", head("labelList") + "0\n");
  return mesh;
}

}  // namespace

TEST_CASE_TEMPLATE("OpenFOAM: binary files are read, and points go back in the same form", Numbers,
                   std::pair<std::int32_t, double>, std::pair<std::int64_t, double>,
                   std::pair<std::int32_t, float>) {
  using Label = typename Numbers::first_type;
  using Scalar = typename Numbers::second_type;
  for (const bool big_endian : {false, true}) {
    CAPTURE(big_endian);
    const TemporaryFolder folder;
    const fs::path mesh = write_binary_cube<Label, Scalar>(folder.path(), big_endian);
    const std::string old = read_text(mesh / "points"), old_faces = read_text(mesh / "faces");
    io::MeshFile file = io::read_mesh(mesh);
    CHECK(file.mesh.topology->element_type(0) == ElementType::hexahedron);
    CHECK(file.mesh.coordinates.xyz(5) == Vec3(1, 0, 1));
    io::write_mesh(mesh, file.mesh, file.details.get());
    CHECK(read_text(mesh / "points") == old);
    file.mesh.coordinates.set_xyz(7, {1.25, 1, 1});
    io::write_mesh(mesh, file.mesh, file.details.get());
    CHECK(read_text(mesh / "points").size() == old.size());
    CHECK(read_text(mesh / "faces") == old_faces);
    CHECK(io::read_mesh(mesh).mesh.coordinates == file.mesh.coordinates);
    io::WriteOptions as_text;
    as_text.keep_encoding = false;
    io::write_mesh(mesh, file.mesh, file.details.get(), as_text);
    CHECK_CONTAINS(read_text(mesh / "points"), "format ascii;");
    CHECK_CONTAINS(read_text(mesh / "points"), "\n(1.25 1 1)\n");
    CHECK(io::read_mesh(mesh).mesh.coordinates == file.mesh.coordinates);
  }
}

TEST_CASE("OpenFOAM: damaged binary files name the byte") {
  const TemporaryFolder folder;
  const fs::path mesh = write_binary_cube<std::int32_t, double>(folder.path(), false);
  const std::string owner = read_text(mesh / "owner");
  write_text(mesh / "owner", owner.substr(0, owner.size() - 10));
  CHECK_THROWS_WITH_AS(io::read_mesh(mesh), doctest::Contains("owner: byte "), InputError);
  write_text(mesh / "owner", "6{0}");
  CHECK(io::read_mesh(mesh).mesh.topology->element_count() == 1);
  write_text(mesh / "owner", "2000000000{0}");
  CHECK_THROWS_AS(io::read_mesh(mesh), InputError);
}

TEST_CASE("OpenFOAM: cyclic patches are pairs, planes of symmetry and groups have their roles") {
  const io::MeshFile file = io::read_mesh(test_data("openfoam/cyclic"));
  REQUIRE(file.details->periodic->pairs.size() == 1);
  const GivenPairs& pairs = file.details->periodic->pairs[0];
  CHECK(pairs.fault.empty());
  CHECK(pairs.first == "cycA");
  CHECK(pairs.second == "cycB");
  CHECK(pairs.pairs.size() > 20);
  for (const auto& [node, image] : pairs.pairs) {
    const Vec3 way = file.mesh.coordinates.xyz(image) - file.mesh.coordinates.xyz(node);
    CHECK((way - Vec3(0, 1, 0)).norm() < 1e-14);
  }
  const io::MarkerRoles& roles = file.details->roles;
  CHECK(roles.pairs_move);
  REQUIRE(roles.symmetry.size() == 1);
  CHECK(roles.symmetry[0] == std::pair<std::string, std::string>("top", "symmetryPlane"));
  CHECK(roles.groups.at("b") == std::vector<std::string>{"bafM", "bafS"});
  CHECK(roles.groups.at("wall") == std::vector<std::string>{"walls.low", "bafM", "bafS"});
}

TEST_CASE("OpenFOAM: boundary faces in no marker get a patch, names are made safe") {
  MeshData data = cube(1, Volumes::hexahedra);
  data.markers.erase(data.markers.begin() + 1);
  data.markers[0].name = "hot wall";
  const TemporaryFolder folder;
  const auto warnings = io::write_mesh(folder / "polyMesh", make_mesh(data), nullptr);
  CHECK(any_contains(warnings, "as the patch defaultFaces"));
  CHECK(any_contains(warnings, "is written as \"hot_wall\""));
  const io::MeshFile file = io::read_mesh(folder / "polyMesh");
  CHECK(file.mesh.topology->markers().find("defaultFaces"));
  CHECK(file.mesh.topology->markers().find("hot_wall"));
}

TEST_CASE("OpenFOAM: split hexahedra come back as they were, and move with their files") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(split_box_with_body(4));
  const fs::path first = folder / "a/constant/polyMesh", second = folder / "b/constant/polyMesh";
  io::write_mesh(first, mesh, nullptr);
  const io::MeshFile file = io::read_mesh(first);
  const Topology& topology = *file.mesh.topology;
  // Cells that are hexahedra by their faces are read as such.
  const auto polyhedra = std::ranges::count(topology.element_types(), ElementType::polyhedron);
  CHECK(polyhedra > 5);
  CHECK(std::ranges::count(topology.element_types(), ElementType::hexahedron) ==
        topology.element_count() - polyhedra);
  CHECK(topology.face_count() == mesh.topology->face_count());
  CHECK(check_validity(topology, file.mesh.coordinates).inverted == 0);
  for (Index e = 0; e < topology.element_count(); ++e)
    CHECK(node_set(topology.element(e)) == node_set(mesh.topology->element(e)));
  // Another mesh with the nodes moved has the same files but for its points.
  Mesh moved = file.mesh;
  for (Index i = 0; i < moved.coordinates.size(); ++i)
    moved.coordinates.set_xyz(i, 2 * moved.coordinates.xyz(i));
  io::write_mesh(second, moved, file.details.get());
  for (const char* name : {"faces", "owner", "neighbour", "boundary"}) {
    CAPTURE(name);
    CHECK(read_text(first / name) == read_text(second / name));
  }
  CHECK(read_text(first / "points") != read_text(second / "points"));
  CHECK(io::read_mesh(second).mesh.coordinates == moved.coordinates);
}

TEST_CASE("OpenFOAM: a hexahedron with a corner in a flat wall is a polyhedron among polyhedra") {
  // The corner (1, 1, 1) of a cube of split_box_with_body() moves into the plane of its neighbours.
  const TemporaryFolder folder;
  MeshData data = split_box_with_body(4);
  for (Index i = 0; i < data.node_count(); ++i)
    if (data.coordinates.xyz(i) == Vec3(1, 1, 1))
      data.coordinates.set_xyz(i, Vec3::Constant(1 - 0.25 * 0.68));
  const Mesh mesh = make_mesh(data);
  io::write_mesh(folder / "constant/polyMesh", mesh, nullptr);
  const io::MeshFile file = io::read_mesh(folder / "constant/polyMesh");
  const Mesh& read = file.mesh;
  CHECK_CONTAINS(file.warnings.at(0),
                 "1 cell is inverted or flat at a corner and sound by the faces");
  CHECK(check_validity(*read.topology, read.coordinates).inverted == 0);
  const Index last = read.topology->element_count() - 1;
  CHECK(read.topology->element_type(last) == ElementType::polyhedron);
  CHECK(read.topology->shape(last).faces.size() == 6);
  CHECK(read.topology->element_type(last - 1) == ElementType::hexahedron);
}

TEST_CASE("OpenFOAM: faces that bound no cell, and other bad input, with the place") {
  CHECK_CONTAINS(error_of("faces", "4(0 4 6 2)", "3(0 4 6)"),
                 "element 0, a polyhedron, has one face at the edge between corners");
  CHECK_CONTAINS(error_of("faces", "4(1 3 7 5)", "5(1 3 7 5 4)"), "element 0, a polyhedron, has");
  CHECK(error_of("faces", "4(1 3 7 5)", "4(1 3 8 5)") == "faces:4: found point 8, expected 0 to 7");
  CHECK(error_of("faces", "4(1 3 7 5)", "4(1 3 7)") ==
        "faces:4: found ')', expected a point of face 2 of 6");
  CHECK_CONTAINS(error_of("faces", "6\n(", "7\n("),
                 "faces:9: found ')', expected the number of po");
  CHECK_CONTAINS(error_of("points", "(1 1 1)", "(1 nan 1)"),
                 "points:17: found nan as a coordinate");
  CHECK_CONTAINS(error_of("points", "format ascii", "format octal"),
                 "points:4: found 'octal', expected ascii or binary");
  CHECK_CONTAINS(error_of("points", "*/", ""), "points:1: found a comment without end");
  CHECK_CONTAINS(
      error_of("boundary", "startFace 2", "startFace 3"),
      "boundary:11: found patch 'sides' of 4 faces from 3 on, expected faces from 0 to 5");
  CHECK_CONTAINS(error_of("boundary", "outlet", "inlet"),
                 "boundary:4: found a second patch 'inlet'");
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "a.foam"),
                       doctest::Contains("constant/polyMesh: found no file points"), InputError);
  CHECK_THROWS_WITH_AS(io::read_mesh(folder.path()), doctest::Contains("it is a directory"),
                       InputError);
  const fs::path mesh = write_cube_case(folder.path());
  fs::remove(mesh / "owner");
  CHECK_THROWS_WITH_AS(io::read_mesh(mesh), doctest::Contains("polyMesh: found no file owner"),
                       InputError);
  write_text(mesh / "owner", "6(0 0 0 0 0 9)");
  CHECK_THROWS_WITH_AS(io::read_mesh(mesh), doctest::Contains("owner:1: found cell 9"), InputError);
  write_text(mesh / "owner", "5(0 0 0 0 0)");
  CHECK_THROWS_WITH_AS(io::read_mesh(mesh), doctest::Contains("owner:1: found 5 cells"),
                       InputError);
}

}  // namespace winslow::test
