#include <doctest/doctest.h>

#include "gui/support/sphere_rig.h"

namespace winslow::gui::test {

namespace {

void choose_nodes(Rig& rig, const std::string& nodes) {
  rig.click("vcv/spread");
  rig.frames(3);
  rig.click("vcv/spread/" + nodes);
  REQUIRE(rig.settle());
  rig.frames(2);
}

/// Gives a node a control volume of its own by a typed length.
void edit(SphereStudio& studio, Index node) {
  studio.inspect(node);
  studio.fill("vcv/length", "1.7");
  REQUIRE(studio.settle());
  REQUIRE(studio.view(node).edited);
  studio.frames(2);
}

std::size_t edited_count(const SphereStudio& studio) {
  const auto stencils = sphere_vcvs(studio.session().mesh());
  return stencils ? stencils->size() : 0;
}

bool can_apply(const SphereStudio& studio) {
  return studio.bench->widgets().find("vcv/apply")->enabled;
}

}  // namespace

TEST_CASE("a control volume on the sphere goes to all nodes with the same link, in one step") {
  SphereStudio studio(1300, 1200);
  const Index node = studio.inner();
  edit(studio, node);
  const std::size_t steps = studio.document().history().size();
  const std::size_t inner = studio.mesh().topology->interior_nodes().size();
  choose_nodes(studio, "All nodes");
  REQUIRE(can_apply(studio));
  studio.click("vcv/apply");
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().size() == steps + 1);
  CHECK(edited_count(studio) == inner);
  // The same weights wherever it went: they do not see how it is turned, but which edge is which.
  const VolumeNodalView own = studio.view(node);
  for (const Index other : studio.mesh().topology->interior_nodes()) {
    const auto& lengths = studio.view(other).vcv.lengths;
    CHECK(std::ranges::max(lengths) / std::ranges::min(lengths) ==
          doctest::Approx(std::ranges::max(own.vcv.lengths) / std::ranges::min(own.vcv.lengths)));
  }
  CHECK(check_validity(*studio.mesh().topology, studio.mesh().coordinates).inverted == 0);
  studio.key(keys::z, {keys::control});
  REQUIRE(studio.settle());
  CHECK(edited_count(studio) == 1);
}

TEST_CASE("a control volume on the sphere goes to pinned nodes and within a radius, no further") {
  SphereStudio studio(1300, 1200);
  const Index node = studio.inner();
  edit(studio, node);
  // None is pinned, and the button says what to do.
  choose_nodes(studio, "Pinned nodes");
  CHECK_FALSE(can_apply(studio));
  const Index pinned = studio.mesh().topology->interior_nodes()[2];
  studio.bench->apply(action::PinNodes{{pinned}});
  REQUIRE(studio.settle());
  studio.frames(2);
  REQUIRE(can_apply(studio));
  studio.click("vcv/apply");
  REQUIRE(studio.settle());
  CHECK(edited_count(studio) == 2);
  CHECK(studio.view(pinned).edited);

  choose_nodes(studio, "Nodes within a radius");
  studio.fill("vcv/radius", "1e-9");
  REQUIRE(studio.settle());
  studio.frames(2);
  CHECK_FALSE(can_apply(studio));
  const double radius = 1.3 * studio.view(node).physical.mean_length();
  studio.fill("vcv/radius", std::to_string(radius));
  REQUIRE(studio.settle());
  studio.frames(2);
  REQUIRE(can_apply(studio));
  const Coordinates x = studio.mesh().coordinates;
  studio.click("vcv/apply");
  REQUIRE(studio.settle());
  int within = 0;
  for (const Index other : studio.mesh().topology->interior_nodes()) {
    const bool near = (x.xyz(other) - x.xyz(node)).norm() <= radius;
    within += near;
    CHECK(studio.view(other).edited == (near || other == pinned));
  }
  CHECK(within > 3);
}

}  // namespace winslow::gui::test
