#include "core/inspect/node_roles.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/meshes.h"
#include "support/periodic_meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Index count_of(const NodeRoles& roles, NodeRole role) {
  CHECK(roles.counts[static_cast<std::size_t>(role)] == std::ranges::count(roles.roles, role));
  return roles.counts[static_cast<std::size_t>(role)];
}

}  // namespace

TEST_CASE("roles in the plane: corners stay, stretches slide, pairs move together") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  SlideOptions slide;
  const NodeRoles still = node_roles(mesh, slide, {});
  CHECK(still.fault.empty());
  CHECK(count_of(still, NodeRole::free) == 25);
  CHECK(count_of(still, NodeRole::fixed) == 24);

  slide.markers = {"top"};
  slide.periodic = {"left", "right"};
  const NodeRoles roles = node_roles(mesh, slide, {"bottom"});
  CHECK(roles.fault.empty());
  CHECK(count_of(roles, NodeRole::on_curve) == 5);
  CHECK(count_of(roles, NodeRole::corner) == 0);  // those of the top slide with their images
  CHECK(count_of(roles, NodeRole::periodic) == 12);
  CHECK(count_of(roles, NodeRole::moves) == 7);
  CHECK(count_of(roles, NodeRole::free) == 25);
  REQUIRE(roles.found.size() == 2);
  CHECK(roles.found[0] == "top: straight line");
  CHECK(roles.found[1] == "left and right: translation by (1, 0)");
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    if (roles.roles[at(i)] == NodeRole::on_curve) CHECK(mesh.coordinates.xy(i).y() == 1);
}

TEST_CASE("held stretches stay, or move with a body that moves an end of them") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  SlideOptions slide;
  slide.markers = {"top"};
  slide.spacing = SlideSpacing::held;
  const NodeRoles stays = node_roles(mesh, slide, {});
  CHECK(count_of(stays, NodeRole::on_curve) == 0);
  CHECK(count_of(stays, NodeRole::corner) == 7);
  CHECK(stays.found[0] == "top: straight line, spacing held: stays between its ends");
  const NodeRoles moves = node_roles(mesh, slide, {"left"});
  CHECK(count_of(moves, NodeRole::moves) == 7 + 5 + 5);  // the bottom follows, too
  CHECK(moves.found[0] == "top: straight line, spacing held: follows its ends");
}

TEST_CASE("roles follow the feature angle") {
  // All four sides as one marker: its corners turn by 90 degrees.
  MeshData data = square(6, Cells::quads);
  Marker all;
  all.name = "all";
  for (const Marker& marker : data.markers)
    all.faces.insert(all.faces.end(), marker.faces.begin(), marker.faces.end());
  data.markers = {all};
  const Mesh mesh = make_mesh(data);
  SlideOptions slide;
  slide.markers = {"all"};
  slide.feature_angle = 40;
  const NodeRoles sharp = node_roles(mesh, slide, {});
  CHECK(count_of(sharp, NodeRole::corner) == 4);
  slide.feature_angle = 120;
  CHECK(count_of(node_roles(mesh, slide, {}), NodeRole::corner) < 4);
}

TEST_CASE("roles in space: faces slide, their edges stay, and are listed") {
  const Mesh mesh = make_mesh(cube(4, Volumes::tetrahedra));
  SlideOptions slide;
  slide.markers = {"lid"};
  const NodeRoles roles = node_roles(mesh, slide, {});
  CHECK(roles.fault.empty());
  CHECK(count_of(roles, NodeRole::on_surface) == 9);
  CHECK(count_of(roles, NodeRole::corner) == 16);
  CHECK(count_of(roles, NodeRole::free) == 27);
  CHECK(roles.features.size() == 16);  // around the lid
  for (const auto& [a, b] : roles.features) {
    CHECK(mesh.coordinates.xyz(a).z() == 1);
    CHECK(mesh.coordinates.xyz(b).z() == 1);
  }
  slide.markers = {"walls", "lid"};
  // The upright edges of the walls, what the lid has, and where the walls end at the floor.
  CHECK(node_roles(mesh, slide, {}).features.size() == 16 + 16 + 16);
  slide.feature_angle = 100;  // more than any edge turns: what is left is where markers end
  CHECK(node_roles(mesh, slide, {}).features.size() == 16 + 16);
}

TEST_CASE("roles of nodes that were told what to do") {
  MeshData data = square(6, Cells::quads);
  Marker all;
  all.name = "all";
  for (const Marker& marker : data.markers)
    all.faces.insert(all.faces.end(), marker.faces.begin(), marker.faces.end());
  data.markers = {all};
  const Mesh mesh = make_mesh(data);
  SlideOptions slide;
  slide.markers = {"all"};
  const auto node_at = [&](const Vec2& p) {
    Index node = 0;
    while (mesh.coordinates.xy(node) != p) ++node;
    return node;
  };
  const auto sorted = [](std::vector<Index> nodes) {
    std::ranges::sort(nodes);
    return nodes;
  };
  const Index corner = node_at({1, 0}), inside = node_at({0.5, 0.5}), on_side = node_at({0.5, 0});
  const std::vector<Index> others{node_at({0, 0}), node_at({0, 1}), node_at({1, 1})};
  const NodeRoles found = node_roles(mesh, slide, {});
  CHECK(found.bends == sorted({corner, others[0], others[1], others[2]}));
  CHECK(found.overridden.empty());
  slide.smooth_nodes = {corner};
  slide.hold_nodes = {inside, on_side};
  const NodeRoles told = node_roles(mesh, slide, {});
  CHECK(told.fault.empty());
  CHECK(told.overridden == sorted({corner, inside, on_side}));
  CHECK(told.bends == sorted(others));
  CHECK(count_of(told, NodeRole::held) == 2);
  CHECK(told.roles[at(corner)] == NodeRole::on_curve);
  CHECK(count_of(told, NodeRole::corner) == 3);
  CHECK(count_of(told, NodeRole::on_curve) == count_of(found, NodeRole::on_curve));
  slide.smooth_nodes = {inside};
  const std::string fault = node_roles(mesh, slide, {}).fault;
  CHECK(fault.find("node " + std::to_string(inside) + " cannot be smooth") == 0);
}

TEST_CASE("what cannot slide or pair is said, and the boundary stays") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  SlideOptions slide;
  slide.periodic = {"left", "top"};
  slide.markers = {"left"};
  const NodeRoles roles = node_roles(mesh, slide, {});
  CHECK_FALSE(roles.fault.empty());
  CHECK(roles.found.empty());
  CHECK(count_of(roles, NodeRole::fixed) == 24);
  slide.periodic.clear();
  slide.markers = {"nowhere"};
  CHECK(node_roles(mesh, slide, {}).fault.find("nowhere") != std::string::npos);
}

TEST_CASE("roles show what gives way to what moves, and what holds it") {
  const Mesh mesh = make_mesh(box_with_body_on_two_planes(6, Volumes::tetrahedra));
  SlideOptions slide;
  const NodeRoles roles = node_roles(mesh, slide, {"body"});
  CHECK(roles.fault.empty());
  CHECK(roles.give_way == std::vector<std::string>{"floor", "side"});
  CHECK(roles.in_the_way.empty());
  CHECK(count_of(roles, NodeRole::on_curve) == 2);  // of the edge, one on either side of the body
  CHECK(count_of(roles, NodeRole::on_surface) > 20);
  CHECK(node_roles(mesh, slide, {}).give_way.empty());
  slide.fixed = {"side", "floor"};
  const NodeRoles held = node_roles(mesh, slide, {"body"});
  CHECK(held.give_way.empty());
  CHECK(count_of(held, NodeRole::on_surface) == 0);
  REQUIRE(held.found.size() == 2);
  CHECK(std::ranges::count(held.found,
                           "body shares 7 nodes with side, which stays (--fixed side)") == 1);
}
