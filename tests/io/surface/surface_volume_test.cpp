#include <Eigen/Geometry>
#include <map>
#include <sstream>

#include "io/support/volume_samples.h"

namespace winslow::test {
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

}  // namespace winslow::test
