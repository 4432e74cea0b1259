#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "core/inspect/nodal_view.h"
#include "core/quality/quality.h"
#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

/// A free node in the middle of the ring with six neighbours, none of them on the boundary.
inline Index inner_node(const Rig& rig, std::size_t skip = 0) {
  const Topology& topology = *rig.mesh().topology;
  for (const Index node : topology.interior_nodes()) {
    const auto ring = topology.neighbours(node);
    const bool inner = ring.size() == 6 &&
                       std::ranges::none_of(ring, [&](Index k) { return topology.on_boundary(k); });
    if (inner && skip-- == 0) return node;
  }
  FAIL("no such node");
  return -1;
}

inline NodalView view_of(const Rig& rig, Index node) {
  return inspect_node(*rig.session().vcv(), rig.session().coordinates(), node);
}

inline void open_ring(Rig& rig) {
  rig.open(ring_mesh());
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  rig.click("tab/vcv");
}

inline bool valid(const Rig& rig) {
  return check_validity(*rig.mesh().topology, rig.session().coordinates()).inverted == 0;
}

inline void enter_node(Rig& rig, const std::string& number) {
  rig.click("vcv/node");
  rig.key(keys::a, {keys::control});
  rig.type(number);
  rig.key(keys::enter);
}

/// A studio with a cube of tetrahedra, its inner nodes shaken, and the tab VCV open.
struct SphereStudio : Rig {
  explicit SphereStudio(int width = 1300, int height = 1000) : Rig(width, height) {
    open(winslow::test::shaken_box(4, 0.15, 31));
    click("tab/vcv");
    frames();
  }
  /// A node well inside, with so many tetrahedra around it that no number is left out for want of
  /// variety.
  Index inner() const { return mesh().topology->interior_nodes()[13]; }
  void inspect(Index node) {
    bench->apply(action::InspectNode{node});
    frames(3);
  }
  const VolumeNodalView& view(Index node) const {
    return session().inspection().spheres.view_of(node);
  }
  WidgetMap::Rect rect(const std::string& id) const {
    const auto found = bench->widgets().find(id);
    REQUIRE_MESSAGE(found.has_value(), id);
    return *found;
  }
  ScreenPoint middle(const std::string& id) const { return rect(id).centre(); }
  /// Points of the VCV that are before the solid, in its picture.
  std::vector<std::size_t> front_points(Index node) const {
    std::vector<std::size_t> points;
    for (std::size_t k = 0; k < view(node).neighbours.size(); ++k)
      if (visible("vcv/end/" + std::to_string(k))) points.push_back(k);
    return points;
  }
  /// The one of them that is nearest to the middle of the picture.
  std::size_t nearest_point(Index node) const {
    const auto points = front_points(node);
    REQUIRE_FALSE(points.empty());
    const auto off = [&](std::size_t k) {
      return (middle("vcv/end/" + std::to_string(k)) - middle("vcv/plot")).norm();
    };
    return *std::ranges::min_element(points, {}, off);
  }
  void drag_point(std::size_t k, const ScreenVector& by) {
    const ScreenPoint from = middle("vcv/end/" + std::to_string(k));
    drag(from, from + by, 5);
  }
  /// Ids of what is on screen that begin so.
  int count(const std::string& prefix, std::size_t most) const {
    int n = 0;
    for (std::size_t k = 0; k < most; ++k) n += visible(prefix + std::to_string(k)) ? 1 : 0;
    return n;
  }
  void enter_node(const std::string& number) {
    click("vcv/node");
    key(keys::a, {keys::control});
    type(number);
    key(keys::enter);
    frames(2);
  }
};

}  // namespace winslow::gui::test
