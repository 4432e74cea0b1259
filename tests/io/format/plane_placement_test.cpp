#include "io/format/mesh_in_space.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>

#include "core/quality/quality.h"
#include "io/format/mesh_format.h"
#include "io/support/files.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Placed = std::function<Vec3(const Vec2&)>;

struct Case {
  const char* name;
  Placed place;
  const char* said;           // of the plane and its axes
  Vec2 at = Vec2(0.25, 0.5);  // in-plane coordinates of the node at (0.25, 0.5)
  bool behind = false;
};

const double s = std::sqrt(0.5);

/// Planes in space; those "from behind" have their elements clockwise as winslow looks at them.
std::vector<Case> cases() {
  return {
      {"x-z", [](const Vec2& p) { return Vec3(p.x(), 0.5, p.y()); },
       "the plane y = 0.5 of space: its coordinates are (x, z)"},
      {"x-z from behind", [](const Vec2& p) { return Vec3(p.y(), -2, p.x()); },
       "the plane y = -2 of space: its coordinates are (x, z)", Vec2(0.5, 0.25), true},
      {"y-z", [](const Vec2& p) { return Vec3(0, p.x(), p.y()); },
       "the plane x = 0 of space: its coordinates are (y, z)"},
      {"y-z from behind", [](const Vec2& p) { return Vec3(7, -p.x(), p.y()); },
       "the plane x = 7 of space: its coordinates are (y, z)", Vec2(-0.25, 0.5), true},
      {"z = x", [](const Vec2& p) { return Vec3(s * p.x(), p.y(), s * p.x() + 1); },
       "the plane -0.707107 x + 0.707107 z = 0.707107 of space: its coordinates are along "
       "(0.707107, 0, 0.707107) and (0, 1, 0)",
       Vec2(0.25 + s, 0.5)},
      {"y = -z", [](const Vec2& p) { return Vec3(p.x(), s * p.y(), 3 - s * p.y()); },
       "its coordinates are along (1, 0, 0) and (0, 0.707107, -0.707107)", Vec2(0.25, 0.5 - 3 * s)},
  };
}

std::string obj_text(const MeshData& mesh, const Placed& place) {
  std::string text;
  char line[128];
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Vec3 p = place(mesh.coordinates.xy(i));
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x(), p.y(), p.z());
    text += line;
  }
  for (Index e = 0; e < mesh.element_count(); ++e) {
    text += 'f';
    for (const Index node : mesh.element(e)) text += ' ' + std::to_string(node + 1);
    text += '\n';
  }
  return text;
}

/// x, y, z and corners of the file as it stands.
struct Raw {
  std::vector<Vec3> nodes;
  std::vector<std::vector<int>> faces;
};

Raw raw_obj(const std::filesystem::path& path) {
  std::istringstream text(read_text(path));
  Raw raw;
  std::string line, word;
  while (std::getline(text, line)) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Vec3 p;
      words >> p[0] >> p[1] >> p[2];
      raw.nodes.push_back(p);
    } else {
      auto& face = raw.faces.emplace_back();
      for (int k = 0; words >> k;) face.push_back(k);
    }
  }
  return raw;
}

}  // namespace

TEST_CASE("a mesh in any plane is read in that plane, and written back as it was") {
  const MeshData square_data = square(4, Cells::mixed);
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const TemporaryFolder folder;
    write_text(folder / "a.obj", obj_text(square_data, c.place));
    const io::MeshFile file = io::read_mesh(folder / "a.obj");
    REQUIRE(file.details->plane);
    CHECK(file.details->plane->from_behind == c.behind);
    CHECK(check_validity(*file.mesh.topology, file.mesh.coordinates).inverted == 0);
    REQUIRE_FALSE(file.warnings.empty());
    CHECK_CONTAINS(file.warnings[0], c.said);
    for (const std::string& text : file.warnings)
      CHECK_MESSAGE(text.find("counter-clockwise") == std::string::npos, text);
    for (Index i = 0; i < file.mesh.coordinates.size(); ++i) {
      if (square_data.coordinates.xy(i) == Vec2(0.25, 0.5))
        CHECK((file.mesh.coordinates.xy(i) - c.at).norm() < 1e-14);
    }
    io::write_mesh(folder / "b.obj", file.mesh, file.details.get());
    const Raw a = raw_obj(folder / "a.obj"), b = raw_obj(folder / "b.obj");
    CHECK(a.nodes == b.nodes);
    CHECK(a.faces == b.faces);
  }
}

TEST_CASE("nodes that move stay in the plane, in every format with three coordinates") {
  const MeshData square_data = square(4, Cells::triangles);
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const TemporaryFolder folder;
    write_text(folder / "a.obj", obj_text(square_data, c.place));
    io::MeshFile file = io::read_mesh(folder / "a.obj");
    const Mesh before = file.mesh;
    Index inner = 0;
    while (file.mesh.topology->on_boundary(inner)) ++inner;
    file.mesh.coordinates.set_xy(inner, file.mesh.coordinates.xy(inner) + Vec2(0.01, 0.02));
    for (const char* name : {"b.msh", "b.vtk", "b.vtu", "b.off", "b.ply", "b.stl", "b.obj"}) {
      CAPTURE(name);
      io::write_mesh(folder / name, file.mesh, file.details.get());
      const io::MeshFile back = io::read_mesh(folder / name);
      REQUIRE(back.details->plane);
      CHECK(back.details->plane->from_behind == c.behind);
      CHECK(back.details->plane->normal().isApprox(file.details->plane->normal(), 1e-12));
      if (std::string(name) == "b.stl") continue;  // other numbers of nodes
      for (Index i = 0; i < before.coordinates.size(); ++i) {
        CHECK((back.mesh.coordinates.xy(i) - file.mesh.coordinates.xy(i)).norm() < 1e-14 * 8);
        const Vec3 there = file.details->plane->in_space(i, file.mesh.coordinates.xy(i));
        CHECK(back.details->plane->in_space(i, back.mesh.coordinates.xy(i)) == there);
      }
    }
    io::write_mesh(folder / "c.obj", file.mesh, file.details.get());
    const Raw a = raw_obj(folder / "a.obj"), b = raw_obj(folder / "c.obj");
    const Vec3 normal = file.details->plane->normal();
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
      const Vec3 move = b.nodes[i] - a.nodes[i];
      if (static_cast<Index>(i) == inner) {
        CHECK(move.norm() == doctest::Approx(std::hypot(0.01, 0.02)));
        CHECK(std::abs(move.dot(normal)) < 1e-15 * 16);
      } else {
        CHECK(move == Vec3(0, 0, 0));
      }
    }
  }
}

TEST_CASE("STL facets of a plane in space have its normal") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", obj_text(square(2, Cells::triangles), cases()[1].place));
  const io::MeshFile file = io::read_mesh(folder / "a.obj");
  io::write_mesh(folder / "b.stl", file.mesh, file.details.get());
  CHECK_CONTAINS(read_text(folder / "b.stl"), "facet normal 0 1 0\n");
}

TEST_CASE("SU2 takes the in-plane coordinates, and says so") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", obj_text(square(4, Cells::quads), cases()[1].place));
  const io::MeshFile file = io::read_mesh(folder / "a.obj");
  const auto warnings = io::write_mesh(folder / "b.su2", file.mesh, file.details.get());
  REQUIRE_FALSE(warnings.empty());
  CHECK_CONTAINS(warnings.back(),
                 "with NDIME= 2 an SU2 file has two coordinates: those in the plane y = -2, (x, "
                 "z), are written");
  const io::MeshFile back = io::read_mesh(folder / "b.su2");
  CHECK(back.mesh.coordinates == file.mesh.coordinates);
  CHECK(check_validity(*back.mesh.topology, back.mesh.coordinates).inverted == 0);
}

TEST_CASE("a surface that is not plane is read as a surface mesh, node by node") {
  const auto bent = [](const Vec2& p) { return Vec3(p.x(), p.x() * p.x(), p.y()); };
  const MeshData plane = square(4, Cells::quads);
  const io::MeshFile file = read_from_text("a.obj", obj_text(plane, bent));
  REQUIRE(is_surface(*file.mesh.topology));
  CHECK(file.warnings.empty());
  for (Index i = 0; i < plane.node_count(); ++i)
    CHECK(file.mesh.coordinates.xyz(i) == bent(plane.coordinates.xy(i)));
}

TEST_CASE("noise out of the plane counts for nothing, and stays with its node") {
  std::vector<double> xyz;
  for (int i = 0; i < 4; ++i)
    xyz.insert(xyz.end(), {double(i % 2), 1 + (i == 3 ? 1e-10 : 0), double(i / 2)});
  const auto plane = io::PlanePlacement::find(xyz);
  REQUIRE(plane);
  CHECK(plane->plane_text() == "the plane y = 1");
  CHECK(plane->in_space(3, plane->in_plane(3)) == Vec3(1, 1 + 1e-10, 1));
  CHECK(plane->in_space(3, Vec2(0.5, 0.25)).isApprox(Vec3(0.5, 1 + 1e-10, 0.25), 1e-15));
  CHECK(plane->in_space(9, Vec2(0.5, 0.25)) == Vec3(0.5, 1, 0.25));  // a new node
  xyz[10] = 1 + 1e-8;
  CHECK_FALSE(io::PlanePlacement::find(xyz));
}

TEST_CASE("a tilted plane far from the origin is one, up to the round-off of its coordinates") {
  std::vector<double> xyz;
  for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(0.3, 0.7)}) {
    for (const double c : {1e7 + s * p.x(), -3e7 + p.y(), 2e7 + s * p.x()}) xyz.push_back(c);
  }
  const auto plane = io::PlanePlacement::find(xyz);
  REQUIRE(plane);
  CHECK(plane->u().isApprox(Vec3(s, 0, s), 1e-7));
  CHECK((plane->in_plane(1) - plane->in_plane(0)).norm() == doctest::Approx(1).epsilon(1e-7));
}

TEST_CASE("axes depend on the plane alone, not on the order of its points nor on its side") {
  const Vec3 n = Vec3(0.3, -0.5, 0.4).normalized();
  const Vec3 a = n.unitOrthogonal(), b = n.cross(a);
  std::vector<double> xyz, reversed;
  for (const Vec2& p : {Vec2(0, 0), Vec2(3, 0), Vec2(3, 1), Vec2(0, 1), Vec2(1, 5)}) {
    const Vec3 q = 2 * n + p.x() * a + p.y() * b;
    xyz.insert(xyz.end(), q.data(), q.data() + 3);
    reversed.insert(reversed.begin(), q.data(), q.data() + 3);
  }
  const auto one = io::PlanePlacement::find(xyz), other = io::PlanePlacement::find(reversed);
  REQUIRE(one);
  REQUIRE(other);
  CHECK(one->u().isApprox(other->u(), 1e-12));
  CHECK(one->v().isApprox(other->v(), 1e-12));
  CHECK(one->normal().isApprox(n, 1e-12));  // it points towards -y, its largest component
  CHECK(std::abs(one->u().dot(one->v())) < 1e-15);
  CHECK(one->u().y() > 0);  // the projection of the x-axis
  CHECK(one->u().x() > 0);
}
