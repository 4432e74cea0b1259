#include "io/format/mesh_repair.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/quality/quality.h"
#include "io/format/parsed_mesh.h"
#include "io/support/polyhedra_samples.h"
#include "io/support/samples.h"
#include "io/support/volume_samples.h"

namespace winslow::test {
namespace {

io::MeshFile read_as(const std::string& name, const std::string& text, io::Defects defects) {
  const TemporaryFolder folder;
  write_text(folder / name, text);
  return io::read_mesh(folder / name, {.zone = 0, .defects = defects});
}

/// The surface of a unit cube, twelve triangles that face outwards, as lines of an OBJ file.
std::vector<std::string> cube_faces() {
  return {"f 1 3 2", "f 1 4 3", "f 5 6 7", "f 5 7 8", "f 1 2 6", "f 1 6 5",
          "f 2 3 7", "f 2 7 6", "f 3 4 8", "f 3 8 7", "f 4 1 5", "f 4 5 8"};
}
const std::string cube_points =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";

std::string cube_text(const std::vector<std::string>& faces, const std::string& more_points = "") {
  std::string text = cube_points + more_points;
  for (const std::string& face : faces) text += face + '\n';
  return text;
}

double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto n = mesh.topology->element(e);
    const auto x = [&](std::size_t k) { return mesh.coordinates.xyz(n[k]); };
    sum += x(0).dot(x(1).cross(x(2))) / 6;
  }
  return sum;
}

}  // namespace

TEST_CASE("repair: a sound mesh stays as it is, and that is said") {
  const std::string text = cube_text(cube_faces());
  const io::MeshFile sound = read_as("a.obj", text, io::Defects::refuse);
  const io::MeshFile same = read_as("a.obj", text, io::Defects::repair);
  check_same_mesh(same.mesh, sound.mesh);
  CHECK(any_contains(same.warnings, "repair: nothing to mend was found"));
  CHECK_FALSE(same.details->changed);
}

TEST_CASE("repair: points in one place become one, each that is left out is counted") {
  // The lid has four points of its own; two more belong to nothing.
  std::vector<std::string> faces = cube_faces();
  faces[2] = "f 9 10 11";
  faces[3] = "f 9 11 12";
  const std::string text =
      cube_text(faces, "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 7 7 7\nv 8 8 8\n");
  const io::MeshFile file = read_as("a.obj", text, io::Defects::repair);
  CHECK(file.mesh.topology->node_count() == 8);
  CHECK(file.mesh.topology->boundary_loops().empty());
  CHECK(volume_of(file.mesh) == doctest::Approx(1));
  CHECK(any_contains(file.warnings,
                     "a.obj: repaired: 4 points lie where earlier ones do: they are one now, the "
                     "first at line 9"));
  CHECK(any_contains(file.warnings,
                     "repaired: 2 points that no element uses are left out, the first at line 13"));
  CHECK(file.details->changed);
}

TEST_CASE("repair: facets given twice, without area, and with a corner twice") {
  std::vector<std::string> faces = cube_faces();
  faces.emplace_back("f 2 1 3");  // a copy, seen from the other side
  faces.emplace_back("f 4 4 8");
  const io::MeshFile file = read_as("a.obj", cube_text(faces), io::Defects::repair);
  CHECK(file.mesh.topology->element_count() == 12);
  CHECK(any_contains(file.warnings,
                     "1 element has the points of an earlier one: left out, at line 21"));
  CHECK(any_contains(file.warnings, "1 element that uses a point twice is left out, at line 22"));
  // A point in the middle of the edge 1 2 of one side only: the flat triangle closes the gap.
  faces = cube_faces();
  faces[4] = "f 1 9 6";
  faces.emplace_back("f 9 2 6");
  faces.emplace_back("f 1 2 9");
  const io::MeshFile flat = read_as("a.obj", cube_text(faces, "v 0.5 0 0\n"), io::Defects::repair);
  CHECK(flat.mesh.topology->element_count() == 14);
  CHECK(flat.mesh.topology->boundary_loops().empty());
  CHECK(volume_of(flat.mesh) == doctest::Approx(1));
  CHECK(any_contains(flat.warnings, "1 triangle has no area: its neighbour is cut"));
  CHECK(measure_quality(flat.mesh).inverted == 0);
}

TEST_CASE("repair: facets that face the other way are turned, a closed surface outwards") {
  std::vector<std::string> faces = cube_faces();
  faces[0] = "f 1 2 3";
  faces[6] = "f 2 7 3";
  const io::MeshFile file = read_as("a.obj", cube_text(faces), io::Defects::repair);
  CHECK(volume_of(file.mesh) == doctest::Approx(1));
  CHECK(any_contains(file.warnings, "2 elements face the other way than their neighbours"));
  for (std::string& face : faces)
    face = "f " + face.substr(6, 1) + ' ' + face.substr(4, 1) + ' ' + face.substr(2, 1);
  const io::MeshFile inside_out = read_as("a.obj", cube_text(faces), io::Defects::repair);
  CHECK(volume_of(inside_out.mesh) == doctest::Approx(1));
  CHECK(any_contains(inside_out.warnings, "10 elements face the other way"));
}

TEST_CASE("repair: elements of plane and volume meshes that use a point twice get smaller") {
  // A quadrilateral with its last corners in one place; marker edges that shrink to a point go.
  const std::string plane =
      "NDIME= 2\nNELEM= 2\n9 0 1 2 3\n5 1 4 2\nNPOIN= 5\n0 0\n1 0\n1 1\n1 1\n2 0\n"
      "NMARK= 2\nMARKER_TAG= low\nMARKER_ELEMS= 2\n3 0 1\n3 1 4\n"
      "MARKER_TAG= top\nMARKER_ELEMS= 2\n3 2 3\n3 3 0\n";
  const io::MeshFile file = read_as("a.su2", plane, io::Defects::repair);
  CHECK(file.mesh.topology->node_count() == 4);
  CHECK(file.mesh.topology->element_type(0) == ElementType::triangle);
  CHECK(any_contains(file.warnings, "1 element uses a point twice: a smaller one is left of it"));
  CHECK(any_contains(file.warnings, "1 face of a marker is no side of an element any more"));
  CHECK(file.mesh.topology->markers()[0].faces.size() == 2);
  CHECK(file.mesh.topology->markers()[1].faces.size() == 1);
  const TemporaryFolder folder;
  io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  check_same_mesh(io::read_mesh(folder / "b.su2").mesh, file.mesh);
  // A hexahedron one of whose edges is a point is a prism.
  MeshData data = cube(1, Volumes::hexahedra);
  data.markers.clear();
  const auto n = data.element(0);
  data.coordinates.set_xyz(n[3], data.coordinates.xyz(n[0]));
  data.coordinates.set_xyz(n[7], data.coordinates.xyz(n[4]));
  io::ParsedMesh parsed;
  parsed.data = data;
  const auto said = io::repair(parsed, io::Source("a", "b"));
  REQUIRE(parsed.data.element_count() == 1);
  CHECK(parsed.data.types[0] == ElementType::prism);
  CHECK(parsed.data.node_count() == 6);
  CHECK(measure_quality(make_mesh(parsed.data)).inverted == 0);
  CHECK(any_contains(said, "2 points lie where earlier ones do"));
}

TEST_CASE("repair: an element of a point that does not exist is damage, which nothing mends") {
  const std::string text =
      "NDIME= 2\nNELEM= 2\n5 0 1 2\n5 0 2 7\nNPOIN= 4\n0 0\n1 0\n1 1\n0 1\nNMARK= 0\n";
  for (const io::Defects defects : {io::Defects::refuse, io::Defects::repair}) {
    std::string message;
    try {
      read_as("a.su2", text, defects);
    } catch (const InputError& error) {
      message = error.what();
    }
    CHECK_CONTAINS(message, "a.su2:4: element 1 uses node 7, expected 0 to 3");
    CHECK(message.find("--repair") == std::string::npos);
  }
}

namespace {

/// The halves of a mesh of polyhedra below and above z = 1/2, each with nodes of its own there. The
/// copies come last.
MeshData halves_apart(const MeshData& whole) {
  MeshData data = whole;
  data.types.clear();
  data.element_nodes.clear();
  data.element_offsets = {0};
  data.faces.clear();
  data.face_offsets.clear();
  data.markers.clear();
  std::map<Index, Index> copies;
  const auto copy = [&](Index node) {
    if (std::abs(whole.coordinates.xyz(node).z() - 0.5) > 1e-9) return node;
    const auto [it, fresh] = copies.try_emplace(node, data.node_count());
    if (fresh) data.coordinates.push_xyz(whole.coordinates.xyz(node));
    return it->second;
  };
  for (Index e = 0; e < whole.element_count(); ++e) {
    double height = 0;
    for (const Index node : whole.element(e)) height += whole.coordinates.xyz(node).z();
    const bool above = height > 0.5 * static_cast<double>(whole.element(e).size());
    std::vector<Face> faces;
    for (const Face& face : whole.polyhedron(e)) {
      std::vector<Index> nodes;
      for (const Index node : face) nodes.push_back(above ? copy(node) : node);
      faces.emplace_back(std::span<const Index>(nodes));
    }
    data.add_polyhedron(faces);
  }
  return data;
}

std::vector<std::string> repaired(MeshData& data) {
  io::ParsedMesh parsed;
  parsed.data = data;
  const std::vector<std::string> said = io::repair(parsed, io::Source("a.vtu", ""));
  data = parsed.data;
  return said;
}

}  // namespace

TEST_CASE("repair: polyhedra whose points lie twice in one place are joined") {
  for (const MeshData& whole :
       {as_polyhedra(cube(4, Volumes::hexahedra)), split_box_with_body(6)}) {
    MeshData data = halves_apart(whole);
    REQUIRE(data.node_count() > whole.node_count());
    REQUIRE(Topology::build(data)->face_count() > Topology::build(whole)->face_count());
    const std::vector<std::string> said = repaired(data);
    CHECK(any_contains(said, "lie where earlier ones do: they are one now"));
    check_same_cells(make_mesh(data), make_mesh(whole));
    CHECK(repaired(data).empty());
  }
}

TEST_CASE("repair: polyhedra with a point twice get smaller, flat ones are left out") {
  // An edge of both prisms has no length: they have eleven sides.
  MeshData data = stacked_prisms(12);
  data.markers.clear();
  for (const Index level : {0, 12, 24})
    data.coordinates.set_xyz(level + 5, data.coordinates.xyz(level + 4));
  std::vector<std::string> said = repaired(data);
  CHECK(any_contains(said, "2 elements use a point twice: smaller ones are left of them"));
  const Mesh mesh = make_mesh(data);
  CHECK(mesh.topology->node_count() == 33);
  REQUIRE(mesh.topology->element_count() == 2);
  for (const Index e : {0, 1}) CHECK(mesh.topology->shape(e).faces.size() == 13);
  CHECK(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
  // The upper prism has no height, and a cell is given twice.
  data = stacked_prisms(12);
  data.markers.clear();
  for (Index k = 0; k < 12; ++k) data.coordinates.set_xyz(24 + k, data.coordinates.xyz(12 + k));
  const std::vector<Face> lower(data.polyhedron(0).begin(), data.polyhedron(0).end());
  data.add_polyhedron(lower);
  MeshData shown = data;
  CHECK_THROWS_AS(make_mesh(data), MeshError);
  said = repaired(data);
  CHECK(any_contains(said, "1 element that uses a point twice is left out"));
  CHECK(any_contains(said, "1 element has the points of an earlier one: left out"));
  CHECK(make_mesh(data).topology->element_count() == 1);
  // To be shown, it need not be mended.
  io::ParsedMesh parsed;
  parsed.data = shown;
  CHECK(any_contains(io::leave_out_defects(parsed, io::Source("a.vtu", "")),
                     "1 element has the points of an earlier one: left out"));
  CHECK(parsed.data.element_count() == 2);
}

TEST_CASE("a defective mesh is refused for motions and shown otherwise, with what is wrong where") {
  // The corner of the first triangle lies exactly where another point does.
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0.5 0.5 1\nv 0 1 0\n"
      "f 1 2 3\nf 2 4 6\nf 4 3 5\nf 3 2 5\n";
  CHECK_THROWS_AS(read_as("a.obj", text, io::Defects::refuse), InputError);
  // An edge of three triangles, a facet without area.
  const std::string fins =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 2 0 0\n"
      "f 1 2 3\nf 2 1 4\nf 1 2 5\nf 2 4 6\n";
  CHECK_THROWS_WITH_AS(read_as("a.obj", fins, io::Defects::refuse),
                       doctest::Contains("a.obj:9: the edge between nodes 0 and 1 is shared by 3"),
                       InputError);
  const io::MeshFile shown = read_as("a.obj", fins, io::Defects::show);
  CHECK(shown.defective);
  CHECK(shown.mesh.topology->element_count() == 3);
  CHECK(any_contains(shown.warnings, "line 9: the edge between nodes 0 and 1 is shared by 3"));
  CHECK(any_contains(shown.warnings,
                     "1 element at an edge or face that has two already is left "
                     "out, at line 9"));
  const std::string flat = "v 0 0 0\nv 1 0 0\nv 0 1 1\nv 0.5 0 0\nf 1 2 3\nf 2 1 4\n";
  CHECK_THROWS_WITH_AS(read_as("a.obj", flat, io::Defects::refuse),
                       doctest::Contains("has no area (its corners lie on one line); --repair"),
                       InputError);
  const io::MeshFile kept = read_as("a.obj", flat, io::Defects::show);
  CHECK(kept.defective);
  CHECK(kept.mesh.topology->element_count() == 2);
  CHECK(any_contains(kept.warnings, "line 6: element 1 has no area"));
  measure_quality(kept.mesh);
  // Two triangles that touch in a point only.
  const io::MeshFile touching =
      read_as("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nv -1 0 0\nv 0 -1 1\nf 1 2 3\nf 1 4 5\n",
              io::Defects::show);
  CHECK(touching.mesh.topology->node_count() == 6);
  CHECK(any_contains(touching.warnings, "1 point in which parts only touch is shown as several"));
  const io::MeshFile sound = read_as("a.obj", cube_text(cube_faces()), io::Defects::show);
  CHECK_FALSE(sound.defective);
}

}  // namespace winslow::test
