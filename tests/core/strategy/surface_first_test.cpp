#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/command/command.h"
#include "core/error.h"
#include "core/mesh/surface_faces.h"
#include "core/quality/quality.h"
#include "support/space_meshes.h"

/// The boundary of a volume mesh before its interior.
namespace winslow::test {
namespace {

std::vector<std::string> all_markers(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Marker& marker : mesh.topology->markers()) names.push_back(marker.name);
  return names;
}

/// A cube, the nodes inside its sides drawn towards one corner of theirs.
Mesh drawn_cube() {
  MeshData data = cube(6, Volumes::tetrahedra);
  for (Index i = 0; i < data.node_count(); ++i) {
    Vec3 p = data.coordinates.xyz(i);
    int at_ends = 0;
    for (const double c : p) at_ends += c == 0 || c == 1 ? 1 : 0;
    if (at_ends > 1) continue;
    for (double& c : p) c = std::pow(c, 1.4);
    data.coordinates.set_xyz(i, p);
  }
  return make_mesh(data);
}

}  // namespace

TEST_CASE("surface first: the boundary is that of a surface mesh smoothed by itself") {
  const Mesh mesh = drawn_cube();
  SmoothCommand command;
  command.smooth.targets = TargetBlend::regular();
  command.smooth.slide.markers = all_markers(mesh);
  command.smooth.slide.surface_first = true;
  const CommandResult result = execute(command, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK_FALSE(result.smooth.boundary.sliding.empty());
  // A square of the boundary by itself: what smoothing the surface mesh of it leads to.
  const Mesh& after = result.state.mesh;
  const auto faces = boundary_faces(*after.topology);
  MeshData surface;
  surface.coordinates = Coordinates(3, mesh.coordinates.size());
  MeshData smoothed = surface;
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    surface.coordinates.set_xyz(i, mesh.coordinates.xyz(i));
    smoothed.coordinates.set_xyz(i, after.coordinates.xyz(i));
  }
  for (const SurfaceFace& face : faces)
    surface.add_element(ElementType::triangle, std::span(face.nodes.begin(), face.nodes.end()));
  SmoothCommand alone;
  alone.smooth.targets = TargetBlend::regular();
  const CommandResult expected = execute(alone, make_state(make_mesh(surface)));
  REQUIRE(expected.smooth.converged);
  double moved = 0, off = 0;
  for (const SurfaceFace& face : faces)
    for (const Index node : face.nodes) {
      moved = std::max(moved, (after.coordinates.xyz(node) - mesh.coordinates.xyz(node)).norm());
      off = std::max(
          off, (after.coordinates.xyz(node) - expected.state.mesh.coordinates.xyz(node)).norm());
    }
  CHECK(moved > 0.02);
  CHECK(off < 1e-9);
}

TEST_CASE("surface first: what it is not for is refused by name") {
  const MeshState state = make_state(make_mesh(cube(3, Volumes::tetrahedra)));
  SmoothCommand command;
  command.smooth.slide.surface_first = true;
  CHECK_THROWS_WITH_AS(execute(command, state), doctest::Contains("no marker slides"), UsageError);
  const MeshState plane = make_state(make_mesh(square(6, Cells::triangles)));
  command.smooth.slide.markers = {"bottom"};
  CHECK_THROWS_WITH_AS(execute(command, plane), doctest::Contains("volume mesh"), UsageError);
}

}  // namespace winslow::test
