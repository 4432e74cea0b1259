#include "core/geometry/footholds.h"

#include <doctest/doctest.h>

#include "support/meshes.h"
#include "support/periodic_meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Footholds footholds_of(const Mesh& mesh, const std::string& body,
                       const std::vector<std::string>& sliding = {}) {
  const std::vector<Index> nodes =
      mesh.topology->markers().nodes_of(std::span<const std::string>(&body, 1));
  FootholdQuery query;
  for (const std::string& name : markers_underfoot(*mesh.topology, nodes, nodes))
    if (std::ranges::find(sliding, name) == sliding.end()) query.markers.push_back(name);
  query.sliding = sliding;
  query.moving = query.standing = nodes;
  return find_footholds(*mesh.topology, mesh.coordinates, query);
}

}  // namespace

TEST_CASE("markers underfoot share nodes with the bodies, and belong to the boundary") {
  const Mesh mesh = make_mesh(square(4, Cells::triangles));
  const std::vector<Index> bottom =
      mesh.topology->markers().nodes_of(std::vector<std::string>{"bottom"});
  std::vector<std::string> names = markers_underfoot(*mesh.topology, bottom, bottom);
  std::ranges::sort(names);
  CHECK(names == std::vector<std::string>{"left", "right"});
  CHECK(body_with(*mesh.topology, bottom, bottom.front()) == "bottom");
  // Nothing stands where nothing moves.
  CHECK(markers_underfoot(*mesh.topology, bottom, {}).empty());
  const Mesh ring = make_mesh(annulus(12, 3, 1.2, Cells::quads));
  const std::vector<Index> inner =
      ring.topology->markers().nodes_of(std::vector<std::string>{"inner"});
  CHECK(markers_underfoot(*ring.topology, inner, inner).empty());
}

TEST_CASE("in the plane a body stands on straight lines, on circles and on neither") {
  const Footholds sides = footholds_of(make_mesh(square(4, Cells::triangles)), "bottom");
  REQUIRE(sides.all.size() == 2);
  for (const Foothold& foothold : sides.all) {
    CHECK(foothold.body == "bottom");
    CHECK(foothold.nodes.size() == 1);
    CHECK(foothold.goes_on);
    CHECK(foothold.description == "straight line");
    // Beyond its ends, too.
    const Vec3 below(foothold.name() == "left" ? 0 : 1, -3, 0);
    CHECK((foothold.nearest(below) - below).norm() < 1e-14);
  }
  CHECK(sides.sliding.parts.size() == 2);

  const Footholds arcs = footholds_of(make_mesh(sector(60, 8, 4, Vec2(1, 2))), "begin");
  REQUIRE(arcs.all.size() == 2);
  for (const Foothold& foothold : arcs.all) CHECK(foothold.description.starts_with("circle"));

  MeshData data = square(8, Cells::quads);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    data.coordinates.set_xy(i, p + Vec2(0.1 * p.x() * std::sin(3 * p.y()), 0));
  }
  const Footholds bent = footholds_of(make_mesh(data), "bottom");
  REQUIRE(bent.all.size() == 2);
  for (const Foothold& foothold : bent.all) CHECK(foothold.goes_on == (foothold.name() == "left"));
  REQUIRE(bent.sliding.parts.size() == 1);
  CHECK(bent.sliding.parts[0].marker == "left");
}

TEST_CASE("in space a body on two planes stands on both, and on the edge between them") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    const Mesh mesh = make_mesh(box_with_body_on_two_planes(6, volumes));
    const Footholds found = footholds_of(mesh, "body");
    REQUIRE(found.all.size() == 4);
    int edges = 0;
    for (const Foothold& foothold : found.all) {
      CHECK(foothold.goes_on);
      CHECK(foothold.body == "body");
      edges += foothold.edge ? 1 : 0;
      CHECK(foothold.description == (foothold.edge ? "straight line" : "plane"));
      if (foothold.edge) CHECK(foothold.name() == "the edge between floor and side");
    }
    CHECK(edges == 2);  // before the body and behind it
    REQUIRE(found.sliding.parts.size() == 4);
    for (const SlidingPart& part : found.sliding.parts)
      for (const Index node : part.nodes) {
        const Vec3 p = mesh.coordinates.xyz(node);
        const bool on_edge = p.y() == 0 && p.z() == 0;
        CHECK(on_edge == (part.description == "straight edge"));
        CHECK((p.x() > 0 && p.x() < 1));
      }
    // Planes that slide anyway are no footholds, but the edge between them is.
    const Footholds edge = footholds_of(mesh, "body", {"side", "floor"});
    CHECK(edge.all.size() == 2);
    CHECK(edge.sliding.parts.size() == 2);
  }
}

TEST_CASE("a curved floor under a body is a foothold that does not go on") {
  MeshData data = box_with_body_on_two_planes(6, Volumes::hexahedra);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec3 p = data.coordinates.xyz(i);
    data.coordinates.set_xyz(i, p + Vec3(0, 0, 0.1 * std::sin(3 * p.x()) * p.y() * (1 - p.z())));
  }
  const Footholds found = footholds_of(make_mesh(data), "body");
  REQUIRE(found.all.size() == 2);  // no edge slides beside a floor that does not
  for (const Foothold& foothold : found.all) CHECK(foothold.goes_on == (foothold.name() == "side"));
  CHECK(found.sliding.parts.size() == 1);
}
