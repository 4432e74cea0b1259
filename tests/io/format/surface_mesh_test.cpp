#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <string>

#include "core/error.h"
#include "io/format/mesh_file.h"
#include "io/format/mesh_format.h"
#include "io/support/files.h"
#include "io/support/samples.h"
#include "support/space_meshes.h"

/// Surface meshes through every format that holds them.
namespace winslow::test {
namespace {

Vec3 bowl(const Vec2& p) { return {p.x(), p.y(), 0.3 * p.squaredNorm()}; }

}  // namespace

TEST_CASE("surface meshes come back from every format that holds them") {
  const TemporaryFolder folder;
  int formats = 0;
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    for (const MeshData& data :
         {lifted(square(5, cells), bowl), skin(cube(2, Volumes::hexahedra))}) {
      const Mesh mesh = make_mesh(data);
      for (const io::MeshFormat* format : io::mesh_formats()) {
        if (!format->can_write(MeshKind::surface)) continue;
        ++formats;
        for (const bool binary : {false, true}) {
          if (binary && !format->has_binary) continue;
          CAPTURE(format->name);
          CAPTURE(binary);
          const auto path = folder / ("a." + std::string(format->name));
          io::WriteOptions options;
          options.binary = binary;
          io::write_mesh(path, mesh, nullptr, options);
          const io::MeshFile back = io::read_mesh(path);
          REQUIRE(is_surface(*back.mesh.topology));
          if (format->name == "stl") {
            CHECK(back.mesh.topology->node_count() == mesh.topology->node_count());
            continue;  // triangles, in an order of its own
          }
          CHECK(back.mesh.coordinates == mesh.coordinates);
          if (format->name == "mesh" && cells == Cells::mixed) continue;  // triangles come first
          REQUIRE(back.mesh.topology->element_count() == mesh.topology->element_count());
          for (Index e = 0; e < mesh.topology->element_count(); ++e) {
            const auto a = mesh.topology->element(e), b = back.mesh.topology->element(e);
            CHECK(std::vector<Index>(a.begin(), a.end()) == std::vector<Index>(b.begin(), b.end()));
          }
        }
      }
    }
  }
  CHECK(formats == 6 * 9);
}

TEST_CASE("surface meshes keep markers on the way through every pair of formats that have them") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(lifted(square(4, Cells::quads), bowl));
  REQUIRE(mesh.topology->markers().size() == 4);
  int pairs = 0;
  for (const io::MeshFormat* first : io::mesh_formats()) {
    if (!first->can_write(MeshKind::surface)) continue;
    const auto one = folder / ("one." + std::string(first->name));
    io::write_mesh(one, mesh, nullptr);
    const io::MeshFile read = io::read_mesh(one);
    for (const io::MeshFormat* second : io::mesh_formats()) {
      if (!second->can_write(MeshKind::surface) || first->name == "stl" || second->name == "stl")
        continue;
      CAPTURE(first->name);
      CAPTURE(second->name);
      ++pairs;
      const auto two = folder / ("two." + std::string(second->name));
      io::write_mesh(two, read.mesh, read.details.get());
      const io::MeshFile back = io::read_mesh(two);
      CHECK(back.mesh.coordinates == mesh.coordinates);
      if (first->keeps_markers && second->keeps_markers)
        check_same_mesh(back.mesh, mesh, {.tags = false, .regions = false});
    }
  }
  CHECK(pairs == 8 * 8);
}

TEST_CASE("surface meshes: a format that cannot hold them says so") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(lifted(square(3, Cells::quads), bowl));
  for (const char* name : {"polyMesh", "a.foam", "a.ugrid"})
    CHECK_THROWS_AS(io::write_mesh(folder / name, mesh, nullptr), UsageError);
}

TEST_CASE("STL of a surface mesh: facets have the normals of its triangles") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(skin(cube(1, Volumes::hexahedra)));
  io::write_mesh(folder / "a.stl", mesh, nullptr);
  const std::string text = read_text(folder / "a.stl");
  for (const char* normal : {"1 0 0", "-1 0 0", "0 1 0", "0 -1 0", "0 0 1", "0 0 -1"}) {
    CAPTURE(normal);
    CHECK(text.find("facet normal " + std::string(normal) + "\n") != std::string::npos);
  }
}

}  // namespace winslow::test
