#include "core/geometry/sliding_boundary.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

namespace winslow::test {
namespace {

SlidingBoundary find(const Mesh& mesh, std::vector<std::string> markers, double angle = 40) {
  return SlidingBoundary::find(*mesh.topology, mesh.coordinates, markers, {.angle = angle});
}

}  // namespace

TEST_CASE("sides of a square slide on lines, their corners stay") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  const SlidingBoundary boundary = find(mesh, {"bottom", "left"});
  REQUIRE(boundary.parts.size() == 2);
  for (const SlidingPart& part : boundary.parts) {
    CHECK(part.description == "straight line");
    CHECK(part.nodes.size() == 5);
    for (const Index node : part.nodes) {
      const Vec2 p = mesh.coordinates.xy(node);
      CHECK((part.marker == "bottom" ? p.y() : p.x()) == 0);
      const Foot foot = boundary.geometry->foot(node, Vec3(p.x() + 0.3, p.y() + 0.1, 0));
      CHECK((part.marker == "bottom" ? foot.point.y() : foot.point.x()) == doctest::Approx(0));
      CHECK(foot.frame.count() == 1);
    }
  }
  CHECK_THROWS_AS(boundary.geometry->foot(mesh.topology->interior_nodes()[0], Vec3(0, 0, 0)),
                  UsageError);
}

TEST_CASE("a marker that goes round a square is cut at its corners, as the angle says") {
  const Mesh mesh = make_mesh(square_with_hole(10, Cells::quads));
  const SlidingBoundary cut = find(mesh, {"outer"});
  CHECK(cut.parts.size() == 4);
  for (const SlidingPart& part : cut.parts) CHECK(part.description == "straight line");
  const SlidingBoundary whole = find(mesh, {"outer"}, 91);
  REQUIRE(whole.parts.size() == 1);
  CHECK(whole.parts[0].nodes.size() == 40);
}

TEST_CASE("circles are found, with all of their nodes") {
  const Mesh mesh = make_mesh(annulus(24, 5, 1.3, Cells::triangles));
  const SlidingBoundary boundary = find(mesh, {"outer", "inner"});
  REQUIRE(boundary.parts.size() == 2);
  CHECK(boundary.parts[1].description == "circle of radius 1");
  for (const SlidingPart& part : boundary.parts) CHECK(part.nodes.size() == 24);
}

TEST_CASE("what cannot slide is refused by name") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  CHECK_THROWS_WITH_AS(find(mesh, {"lid"}), doctest::Contains("lid"), UsageError);
  const Mesh coarse = make_mesh(square(1, Cells::triangles));
  CHECK_THROWS_WITH_AS(find(coarse, {"top"}), doctest::Contains("no node of marker \"top\""),
                       UsageError);
}

TEST_CASE("in space the nodes inside a plane marker slide, those on its edges stay") {
  const Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::tetrahedra));
  std::vector<std::string> names;
  for (const Marker& marker : mesh.topology->markers()) names.push_back(marker.name);
  for (const std::string& name : names) {
    CAPTURE(name);
    const SlidingBoundary boundary = find(mesh, {name});
    std::set<Index> sliding;
    for (const SlidingPart& part : boundary.parts) {
      CHECK(part.description == "plane");
      for (const Index node : part.nodes) {
        sliding.insert(node);
        const Vec3 p = mesh.coordinates.xyz(node);
        const Foot foot = boundary.geometry->foot(node, p);
        CHECK((foot.point - p).norm() < 1e-14);
        REQUIRE(foot.frame.count() == 2);
        // Every boundary face around it lies across the frame.
        for (Index f = 0; f < mesh.topology->face_count(); ++f) {
          const auto face = mesh.topology->face(f);
          if (face.elements[1] >= 0) continue;
          if (std::find(face.nodes.begin(), face.nodes.end(), node) == face.nodes.end()) continue;
          const Vec3 normal = foot.frame[0].cross(foot.frame[1]);
          for (const Index other : face.nodes)
            CHECK(std::abs(normal.dot(mesh.coordinates.xyz(other) - p)) < 1e-12);
        }
      }
    }
    CHECK(!sliding.empty());
  }
}

TEST_CASE(
    "asked for, nodes slide along the edges of a box, between markers as well; corners stay") {
  const Mesh mesh = make_mesh(cube(4, Volumes::hexahedra));
  const std::vector<std::string> all{"floor", "lid", "walls"};
  const SlidingBoundary boundary = SlidingBoundary::find(*mesh.topology, mesh.coordinates, all,
                                                         {.angle = 40, .slide_along = true});
  std::size_t edges = 0, faces = 0;
  for (const SlidingPart& part : boundary.parts) {
    const bool edge = part.description == "straight edge";
    (edge ? edges : faces) += part.nodes.size();
    for (const Index node : part.nodes) {
      const Vec3 p = mesh.coordinates.xyz(node);
      const Foot foot = boundary.geometry->foot(node, p + Vec3(0.05, 0.04, 0.03));
      CHECK(foot.frame.count() == (edge ? 1 : 2));
      for (int k = 0; k < 3; ++k)
        if (p[k] < 1e-9 || p[k] > 1 - 1e-9)
          CHECK(foot.point[k] == doctest::Approx(p[k]).epsilon(1e-14));
    }
  }
  CHECK(edges == 12 * 3);
  CHECK(faces == 6 * 9);
  // Where a marker beside stays, so do the nodes on its border.
  const std::vector<std::string> some{"walls"};
  edges = 0;
  for (const SlidingPart& part : SlidingBoundary::find(*mesh.topology, mesh.coordinates, some,
                                                       {.angle = 40, .slide_along = true})
                                     .parts)
    if (part.description == "straight edge") edges += part.nodes.size();
  CHECK(edges == 4 * 3);
}

TEST_CASE("a cylinder with caps is cut at their rims") {
  // A block of hexahedra whose sides are drawn onto a circle.
  Mesh mesh = make_mesh(cube(8, Volumes::hexahedra));
  for (Index node = 0; node < mesh.coordinates.size(); ++node) {
    const Vec3 p = 2 * mesh.coordinates.xyz(node) - Vec3(1, 1, 1);
    const double square = std::max(std::abs(p.x()), std::abs(p.y()));
    const double round = std::hypot(p.x(), p.y());
    const double share = round > 0 ? square / round : 1;
    mesh.coordinates.set_xyz(node, Vec3(3 * share * p.x(), 3 * share * p.y(), p.z()));
  }
  const std::vector<std::string> all{"floor", "lid", "walls"};
  const SlidingBoundary boundary = SlidingBoundary::find(*mesh.topology, mesh.coordinates, all,
                                                         {.angle = 40, .slide_along = true});
  std::map<std::string, std::size_t> found;
  for (const SlidingPart& part : boundary.parts) found[part.description] += part.nodes.size();
  CHECK(found == std::map<std::string, std::size_t>{{"cylinder of radius 3", 32 * 7},
                                                    {"plane", 2 * 49},
                                                    {"edge, circle of radius 3", 2 * 32}});
  for (const SlidingPart& part : boundary.parts) {
    const Vec3 p = mesh.coordinates.xyz(part.nodes.front());
    const Foot foot = boundary.geometry->foot(part.nodes.front(), p + Vec3(0.1, 0.2, 0.05));
    if (part.description != "plane")
      CHECK(std::hypot(foot.point.x(), foot.point.y()) == doctest::Approx(3).epsilon(1e-12));
    if (part.description != "cylinder of radius 3")
      CHECK(foot.point.z() == doctest::Approx(p.z()).epsilon(1e-12));
    // To second order it runs on as the foot says.
    constexpr double h = 1e-4;
    for (int k = 0; k < foot.frame.count(); ++k) {
      const Vec3& along = foot.frame[k];
      const auto at = [&](double s) {
        return boundary.geometry->foot(part.nodes.front(), foot.point + s * along).point;
      };
      CHECK(((at(h) - at(-h)) / (2 * h) - along).norm() < 1e-7);
      CHECK(((at(h) + at(-h) - 2 * foot.point) / (h * h) - foot.bend[k == 0 ? 0 : 2]).norm() <
            1e-5);
    }
  }
}

TEST_CASE("the tip of a cone stays, and so does what turns by more than the angle") {
  // A pyramid of many sides as a surface mesh.
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  constexpr Index sides = 24, rings = 4;
  data.coordinates.push_xyz(Vec3(0, 0, 1));
  for (Index ring = 1; ring <= rings; ++ring)
    for (Index k = 0; k < sides; ++k) {
      const double angle = 2 * pi * k / sides, r = double(ring) / rings;
      data.coordinates.push_xyz(Vec3(r * std::cos(angle), r * std::sin(angle), 1 - r));
      const Index next = (k + 1) % sides, here = 1 + (ring - 1) * sides;
      const Index inner = here - sides;
      if (ring == 1)
        data.add_element(ElementType::triangle, std::array<Index, 3>{0, here + k, here + next});
      else
        data.add_element(ElementType::quadrilateral,
                         std::array<Index, 4>{inner + k, here + k, here + next, inner + next});
    }
  const Mesh mesh = make_mesh(data);
  const SlidingBoundary boundary =
      SlidingBoundary::find(*mesh.topology, mesh.coordinates, {}, {.angle = 40});
  std::set<Index> sliding;
  for (const SlidingPart& part : boundary.parts)
    sliding.insert(part.nodes.begin(), part.nodes.end());
  for (Index node = 0; node < mesh.topology->node_count(); ++node) {
    const Vec3 p = mesh.coordinates.xyz(node);
    const bool tip = p.z() > 1 - 1e-9, rim = p.z() < 1e-9;
    CHECK(sliding.contains(node) == (!tip && !rim));
  }
}

}  // namespace winslow::test
