#include "gui/shell/workbench/panel_registry.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <set>
#include <stdexcept>

#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// Counts how often it is drawn.
class Counter : public Panel {
 public:
  explicit Counter(int& count) : count_(count) {}
  void draw(const PanelContext&) override { ++count_; }

 private:
  int& count_;
};

RegisteredPanel counter(const char* id, int& count, Region region, MeshKinds serves) {
  return {id, id, region, serves, std::make_unique<Counter>(count), {}};
}

}  // namespace

TEST_CASE("panels are drawn where they stand, if they are shown and serve the mesh") {
  Rig rig;
  int left = 0, right = 0, volume = 0, hidden = 0;
  PanelRegistry registry;
  registry.add(counter("left", left, Region::left, all_meshes));
  registry.add(counter("volume", volume, Region::left, {MeshKind::volume, MeshKind::surface}));
  registry.add(counter("right", right, Region::right, {MeshKind::plane}));
  RegisteredPanel never = counter("hidden", hidden, Region::left, all_meshes);
  never.shown = [](const PanelContext&) { return false; };
  registry.add(std::move(never));
  const Theme theme;
  ActionQueue actions;
  const Workbench& bench = *rig.bench;
  const PanelContext context{rig.session(),
                             bench.view_control().options(),
                             bench.view_control().state(),
                             theme,
                             actions,
                             bench.capture(),
                             bench.recent(),
                             bench.demo()};
  // A line stands in place of a panel that does not serve the mesh.
  ImGui::NewFrame();
  registry.draw(Region::left, context, MeshKind::plane);
  CHECK(left == 1);
  CHECK(volume == 0);
  CHECK(hidden == 0);
  CHECK(right == 0);
  registry.draw(Region::left, context, MeshKind::volume);
  CHECK(left == 2);
  CHECK(volume == 1);
  registry.draw(Region::right, context, MeshKind::plane);
  CHECK(right == 1);
  ImGui::EndFrame();
}

TEST_CASE("two panels of one id are refused") {
  int count = 0;
  PanelRegistry registry;
  registry.add(counter("one", count, Region::left, all_meshes));
  CHECK_THROWS_AS(registry.add(counter("one", count, Region::right, all_meshes)), std::logic_error);
  CHECK(registry.panels().size() == 1);
}

TEST_CASE("every panel of the studio serves plane meshes and has a title") {
  Rig rig;
  const auto& panels = rig.bench->regions().panels().panels();
  CHECK(panels.size() == 25);
  std::set<Region> regions;
  for (const RegisteredPanel& panel : panels) {
    INFO(panel.id);
    CHECK(panel.serves.contains(MeshKind::plane));
    CHECK_FALSE(panel.title.empty());
    regions.insert(panel.region);
  }
  CHECK(regions.size() == 9);
}

}  // namespace winslow::gui::test
