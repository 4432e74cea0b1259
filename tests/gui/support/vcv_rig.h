#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "core/inspect/nodal_view.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"

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

}  // namespace winslow::gui::test
