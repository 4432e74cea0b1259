#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/command/command.h"
#include "core/error.h"
#include "core/geometry/sliding_boundary.h"
#include "core/quality/quality.h"
#include "support/random.h"
#include "support/surface_meshes.h"

/// Surfaces from elsewhere that nodes slide on.
namespace winslow::test {
namespace {

ReferenceSurface reference_of(const MeshData& data) {
  ReferenceSurface out;
  out.source = "fine.obj";
  for (Index i = 0; i < data.node_count(); ++i) out.points.push_back(data.coordinates.xyz(i));
  for (Index e = 0; e < data.element_count(); ++e) out.faces.emplace_back(data.element(e));
  return out;
}

/// Markers: those that slide, of a volume mesh.
SmoothCommand smooth_on_file(std::vector<std::string> markers = {}) {
  SmoothCommand command;
  command.smooth.slide.reference = "fine.obj";
  command.smooth.slide.markers = std::move(markers);
  return command;
}

/// The command with this surface as what it asks for.
ResolvedCommand smooth_on(const MeshData& data, Command command = smooth_on_file()) {
  return {std::move(command),
          {.reference = std::make_shared<ReferenceSurface>(reference_of(data))}};
}

/// How far from the torus about z the nodes of a mesh are, at most.
double off_torus(const Coordinates& x, double ring, double tube) {
  double largest = 0;
  for (Index i = 0; i < x.size(); ++i) {
    const Vec3 p = x.xyz(i);
    largest =
        std::max(largest, std::abs(std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()) - tube));
  }
  return largest;
}

MeshData torus_of(Index n, Index m) {
  return torus_grid(n, m, Cells::triangles, [](const Vec2& p) { return on_torus(p, 3, 1); });
}

/// The surface of a unit cube, n by n quadrilaterals on each side.
MeshData cube_surface(Index n) { return skin(cube(n, Volumes::hexahedra)); }

/// n by n quadrilaterals over the unit square.
MeshData sheet(Index n, const std::function<Vec3(const Vec2&)>& place) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) data.coordinates.push_xyz(place(Vec2(1.0 * i / n, 1.0 * j / n)));
  const auto id = [&](Index i, Index j) { return j * (n + 1) + i; };
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      add_cell(data, Cells::quads, i, j, {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
  return data;
}

/// Two slopes that meet in the crease x = 1/2, z = 0.
Vec3 on_roof(const Vec2& p, double slope) { return {p.x(), p.y(), -slope * std::abs(p.x() - 0.5)}; }

SlidingBoundary along_features(const Mesh& mesh, const ReferenceSurface& reference) {
  return SlidingBoundary::find(*mesh.topology, mesh.coordinates, {},
                               {.angle = 40, .slide_along = true}, &reference);
}

/// How many nodes slide on straight edges.
std::size_t on_edges(const SlidingBoundary& boundary) {
  std::size_t count = 0;
  for (const SlidingPart& part : boundary.parts)
    if (part.description.starts_with("straight edge")) count += part.nodes.size();
  return count;
}

}  // namespace

TEST_CASE("reference surface: nodes of a coarse mesh are put on the finer surface and stay on it") {
  const MeshState state = make_state(make_mesh(torus_of(24, 12)));
  const MeshData fine = torus_of(144, 72);
  const CommandResult own = execute(SmoothCommand{}, state);
  const CommandResult on_fine = execute(smooth_on(fine), state);
  CHECK(on_fine.smooth.converged);
  CHECK(on_fine.smooth.inverted == 0);
  CHECK(on_fine.smooth.boundary.sliding.at(0).description ==
        "smooth surface through 10368 nodes of fine.obj");
  // The surface through the coarse nodes is one of a coarse mesh.
  const double off_own = off_torus(own.state.mesh.coordinates, 3, 1);
  const double off_fine = off_torus(on_fine.state.mesh.coordinates, 3, 1);
  CHECK(off_own > 1e-4);
  CHECK(off_fine < 2e-6);
  CHECK(off_fine < 0.02 * off_own);
}

TEST_CASE("reference surface: a file that is tangled comes back on the shape, not on its tangle") {
  MeshData data = torus_of(24, 12);
  Random random(3);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec3 p = data.coordinates.xyz(i);
    const double round = std::atan2(p.y(), p.x()) + random.uniform(-0.5, 0.5);
    const double along =
        std::atan2(p.z(), std::hypot(p.x(), p.y()) - 3) + random.uniform(-0.9, 0.9);
    data.coordinates.set_xyz(i, on_torus(Vec2(round, along) / (2 * pi), 3, 1));
  }
  const MeshState state = make_state(make_mesh(data));
  const CommandResult result = execute(smooth_on(torus_of(144, 72)), state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  CHECK(off_torus(result.state.mesh.coordinates, 3, 1) < 1e-5);
  CHECK(measure_quality(result.state.mesh).of(Metric::normalized_jacobian).statistics.min > 0.5);
}

TEST_CASE(
    "reference surface: its features are those of the mesh, wherever the mesh has sharp edges") {
  // A cube whose sides bulge by a thousandth, so that the mesh alone has curved sides.
  MeshData data = cube_surface(8);
  Random random(5);
  for (Index i = 0; i < data.node_count(); ++i) {
    Vec3 p = data.coordinates.xyz(i);
    int at_ends = 0;
    for (const double c : p) at_ends += c == 0 || c == 1 ? 1 : 0;
    if (at_ends == 1)
      for (double& c : p)
        c += c == 0 || c == 1 ? 1e-3 * random.uniform(-1, 1) : 0.02 * random.uniform(-1, 1);
    data.coordinates.set_xyz(i, p);
  }
  const Mesh mesh = make_mesh(data);
  const ReferenceSurface reference = reference_of(cube_surface(3));
  const SlidingBoundary boundary = SlidingBoundary::find(
      *mesh.topology, mesh.coordinates, {}, {.angle = 40, .slide_along = true}, &reference);
  std::map<std::string, std::size_t> nodes;
  for (const SlidingPart& part : boundary.parts) nodes[part.description] += part.nodes.size();
  CHECK(nodes.size() == 2);
  CHECK(nodes["plane of fine.obj"] == 6 * 49);
  CHECK(nodes["straight edge of fine.obj"] == 12 * 7);
  const Coordinates x = put_on(boundary, mesh.coordinates);
  for (Index i = 0; i < x.size(); ++i) {
    const Vec3 p = x.xyz(i);
    double nearest = 1;
    for (const double c : p) nearest = std::min({nearest, std::abs(c), std::abs(1 - c)});
    CHECK(nearest < 1e-15);
  }
}

TEST_CASE("reference surface: nodes that a mesh has beside an edge or a corner are put onto it") {
  constexpr Index n = 6;
  constexpr double h = 1.0 / n;
  const Coordinates exact = cube_surface(n).coordinates;
  const auto check_put_back = [&](double beside, const std::function<bool(const Vec3&)>& moves) {
    MeshData data = cube_surface(n);
    std::size_t moved = 0;
    for (Index i = 0; i < exact.size(); ++i) {
      const Vec3 p = exact.xyz(i);
      if (!moves(p)) continue;
      ++moved;
      // At right angles to the edge, or along the diagonal of the cube from its corner.
      Vec3 to = p;
      for (double& c : to)
        if (c == 0) c = beside * h;
      data.coordinates.set_xyz(i, to);
    }
    CHECK(moved > 0);
    const Mesh mesh = make_mesh(data);
    const SlidingBoundary boundary = along_features(mesh, reference_of(cube_surface(4)));
    CHECK(on_edges(boundary) == 12 * (n - 1));
    const Coordinates put = put_on(boundary, mesh.coordinates);
    for (Index i = 0; i < put.size(); ++i) CHECK((put.xyz(i) - exact.xyz(i)).norm() < 1e-14);
  };
  // A chamfer of .36 edges: the mesh turns there by 2 atan(.64 / .36) - 90 = 31 degrees only.
  check_put_back(0.36,
                 [](const Vec3& p) { return p.x() == 0 && p.y() == 0 && p.z() > 0 && p.z() < 1; });
  check_put_back(0.35, [](const Vec3& p) { return p.isZero(0); });
}

TEST_CASE("reference surface: a corner that the mesh has near enough stays where it is") {
  MeshData data = cube_surface(6);
  const auto corner = [&] {
    for (Index i = 0; i < data.node_count(); ++i)
      if (data.coordinates.xyz(i).isZero(0)) return i;
    return Index{-1};
  }();
  const Vec3 given = Vec3::Constant(0.2 / 6);
  data.coordinates.set_xyz(corner, given);
  const Mesh mesh = make_mesh(data);
  const SlidingBoundary boundary = along_features(mesh, reference_of(cube_surface(4)));
  CHECK(boundary.places.empty());
  CHECK(put_on(boundary, mesh.coordinates).xyz(corner) == given);
}

TEST_CASE("reference surface: a crease that no row of edges follows cuts no faces") {
  // The rows of the mesh run at 45 degrees to it.
  const auto turned = [](const Vec2& p) {
    const Vec2 q = p - Vec2(0.5, 0.5);
    return Vec2(0.5 + (q.x() - q.y()) / 2, 0.5 + (q.x() + q.y()) / 2);
  };
  const ReferenceSurface roof =
      reference_of(sheet(24, [](const Vec2& p) { return on_roof(p, 0.6); }));
  const Mesh along = make_mesh(sheet(8, [](const Vec2& p) { return on_roof(p, 0.6); }));
  const Mesh across = make_mesh(sheet(8, [&](const Vec2& p) { return on_roof(turned(p), 0.6); }));
  // The crease, and both slopes of the borders.
  CHECK(on_edges(along_features(along, roof)) == 7 + 2 * 7 + 4 * 3);
  CHECK(on_edges(along_features(across, roof)) == 0);
}

TEST_CASE("reference surface: a node behind which a crease fades out slides on the surface") {
  // It turns by 2 atan(slope): 40 degrees at y = .45.
  const auto fading = [](const Vec2& p) {
    return on_roof(p, std::tan(radians(20)) + 0.4 * (0.45 - p.y()));
  };
  const Mesh mesh = make_mesh(sheet(8, fading));
  const SlidingBoundary boundary = along_features(mesh, reference_of(sheet(80, fading)));
  std::map<Index, std::string> slides_on;
  for (const SlidingPart& part : boundary.parts)
    for (const Index node : part.nodes) slides_on[node] = part.description;
  const auto on_crease = [](Index j) { return 9 * j + 4; };
  for (const Index j : {1, 2}) CHECK(slides_on[on_crease(j)].starts_with("straight edge"));
  for (const Index j : {3, 4, 5, 6, 7})
    CHECK(slides_on[on_crease(j)].starts_with("smooth surface"));
}

TEST_CASE("reference surface: the boundary of a volume mesh slides on its faces and edges") {
  const Mesh mesh = make_mesh(cube(6, Volumes::tetrahedra));
  std::vector<std::string> names;
  for (const Marker& marker : mesh.topology->markers()) names.push_back(marker.name);
  SmoothCommand command = smooth_on_file(names);
  command.smooth.slide.features = true;
  const CommandResult result = execute(smooth_on(cube_surface(4), command), make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  std::size_t sliding = 0;
  for (const SlidingPart& part : result.smooth.boundary.sliding) sliding += part.nodes.size();
  CHECK(sliding == 6 * 25 + 12 * 5);
}

TEST_CASE("reference surface: a body moves in a mesh whose boundary is on it, if that is valid") {
  const Mesh mesh = make_mesh(cube_with_cavity(12, Volumes::tetrahedra));
  const auto box = [](double size) {
    MeshData data = cube_surface(4);
    for (double& value : data.coordinates.values()) value = 0.5 + size * (value - 0.5);
    return data;
  };
  MoveCommand command;
  command.bodies[0].markers = {"cavity"};
  command.bodies[0].motion.translate = Vec2(0.05, 0);
  command.smooth = smooth_on_file({"outer"}).smooth;
  const CommandResult result = execute(smooth_on(box(1.02), command), make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  CHECK(result.smooth.fraction_reached == 1);
  std::size_t sliding = 0;
  for (const SlidingPart& part : result.smooth.boundary.sliding)
    for (const Index node : part.nodes) {
      ++sliding;
      const Vec3 p = result.state.mesh.coordinates.xyz(node) - Vec3::Constant(0.5);
      CHECK(p.cwiseAbs().maxCoeff() == doctest::Approx(0.51).epsilon(1e-12));
    }
  CHECK(sliding == 6 * 121);
  CHECK_THROWS_WITH_AS(execute(smooth_on(box(0.8), command), make_state(mesh)),
                       doctest::Contains("smooth the mesh on it first"), UsageError);
}

TEST_CASE("reference surface: without it a surface mesh goes back to the shape that it was given") {
  const MeshState state = make_state(make_mesh(octasphere(6)));
  MeshData larger = octasphere(12);
  for (double& value : larger.coordinates.values()) value *= 1.05;
  const auto check_radius = [](const MeshState& now, double radius) {
    for (Index i = 0; i < now.mesh.coordinates.size(); ++i)
      CHECK(now.mesh.coordinates.xyz(i).norm() == doctest::Approx(radius).epsilon(1e-12));
  };
  const CommandResult there = execute(smooth_on(larger), state);
  check_radius(there.state, 1.05);
  check_radius(execute(ScrambleCommand{3}, there.state).state, 1.05);
  // Another file of the same name is another surface.
  for (double& value : larger.coordinates.values()) value *= 1.1 / 1.05;
  check_radius(execute(smooth_on(larger), there.state).state, 1.1);
  check_radius(execute(SmoothCommand{}, there.state).state, 1);
}

TEST_CASE("reference surface: what does not fit is refused by name") {
  const MeshState state = make_state(make_mesh(torus_of(24, 12)));
  MeshData far = torus_of(48, 24);
  for (Index i = 0; i < far.node_count(); ++i)
    far.coordinates.set_xyz(i, 1000 * far.coordinates.xyz(i));
  CHECK_THROWS_WITH_AS(execute(smooth_on(far), state), doctest::Contains("away from this surface"),
                       UsageError);
  CHECK_THROWS_WITH_AS(execute(smooth_on_file(), state),
                       "fine.obj: this reference surface was not read", UsageError);
  const MeshState plane = make_state(make_mesh(square(6, Cells::triangles)));
  const ResolvedCommand in_plane = smooth_on(torus_of(24, 12), smooth_on_file({"bottom"}));
  CHECK_THROWS_WITH_AS(execute(in_plane, plane), doctest::Contains("plane mesh"), UsageError);
  const MeshState volume = make_state(make_mesh(cube(3, Volumes::tetrahedra)));
  CHECK_THROWS_WITH_AS(execute(smooth_on(torus_of(24, 12)), volume),
                       doctest::Contains("name their markers"), UsageError);
}

}  // namespace winslow::test
