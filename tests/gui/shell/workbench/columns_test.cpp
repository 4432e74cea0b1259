#include <doctest/doctest.h>
#include <imgui.h>

#include <set>
#include <stdexcept>

#include "gui/shell/workbench/panel_list.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

double columns_width(const Rig& rig) {
  const Layout& layout = rig.bench->layout();
  return static_cast<double>(layout.left.width + layout.right.width);
}

}  // namespace

TEST_CASE("the columns take at most 45 % of the width, whatever the window and the scale") {
  Rig rig(1440, 900);
  rig.open(ring_mesh());
  for (const double scale : {1.0, 1.25, 1.5, 2.0}) {
    set_view(rig, [&](ViewOptions& view) { view.scale = scale; });
    for (const auto& size :
         {std::pair{760, 480}, {1024, 768}, {1280, 800}, {1440, 900}, {2560, 1440}}) {
      const int width = size.first, height = size.second;
      INFO("scale ", scale, ", width ", width);
      rig.resize(width, height);
      rig.frames();
      CHECK(columns_width(rig) <= 0.45 * width + 1);
      // What has no room is folded, not squeezed.
      const Layout& layout = rig.bench->layout();
      const float unit = rig.bench->theme().scale;
      CHECK(layout.columns.left_open);
      CHECK(layout.left.width >= 250 * unit);
      if (layout.columns.right_open) CHECK(layout.right.width >= 280 * unit);
    }
  }
}

TEST_CASE("F2 and F3 fold the columns to icons, which open them at one of their parts") {
  Rig rig(1440, 900);
  rig.open(ring_mesh());
  REQUIRE(rig.visible("solver/method"));
  const float open = rig.bench->layout().left.width;
  rig.key(keys::f2);
  CHECK(rig.bench->layout().left.width < 60);
  CHECK_FALSE(rig.visible("solver/method"));
  rig.click("open/section/layers");
  rig.frames();
  CHECK(rig.bench->layout().left.width == open);
  CHECK(rig.visible("solver/method"));
  CHECK_FALSE(rig.bench->settings().folded.contains("section/layers"));
  rig.key(GLFW_KEY_F3);
  CHECK(rig.bench->layout().right.width < 60);
  rig.click("open/tab/History");
  rig.frames();
  CHECK(rig.bench->view_control().options().side_tab == SideTab::history);
  CHECK(rig.bench->layout().right.width > 200);
  // The handle at the edge does so, too.
  rig.click("fold/left");
  CHECK(rig.bench->layout().left.width < 60);
}

TEST_CASE("where there is room for one column only, opening one folds the other") {
  Rig rig(1024, 768);
  rig.open(ring_mesh());
  CHECK(rig.bench->layout().columns.left_open);
  CHECK_FALSE(rig.bench->layout().columns.right_open);
  rig.click("open/tab/View");
  rig.frames();
  CHECK(rig.bench->layout().columns.right_open);
  CHECK_FALSE(rig.bench->layout().columns.left_open);
  CHECK(rig.visible("view/color"));
  rig.click("open/section/markers");
  rig.frames();
  CHECK(rig.bench->layout().columns.left_open);
  CHECK_FALSE(rig.bench->layout().columns.right_open);
  rig.key(keys::f2);  // to see nothing but the mesh: the other one stays folded
  CHECK_FALSE(rig.bench->layout().columns.left_open);
  CHECK_FALSE(rig.bench->layout().columns.right_open);
}

TEST_CASE("in a low window nothing covers the handles that fold columns") {
  Rig rig(760, 480);
  rig.open(ring_mesh());
  rig.bench->apply(action::RunSmooth{});  // its convergence is shown below the mesh
  REQUIRE(rig.settle());
  for (const char* handle : {"fold/left", "fold/right"}) {
    INFO(handle);
    if (!rig.visible(handle)) rig.click("open/tab/Quality");
    rig.frames();
    const auto place = rig.bench->widgets().find(handle);
    REQUIRE(place.has_value());
    const Area& v = rig.bench->layout().viewport;
    CHECK(place->min.y() >= v.y);
    CHECK(place->max.y() <= v.y + v.height);
  }
}

TEST_CASE("a tab has its name in a column that is folded, too") {
  Rig rig(760, 480);
  rig.open(ring_mesh());
  REQUIRE_FALSE(rig.bench->layout().columns.right_open);
  for (const auto& [name, tab] :
       {std::pair{"tab/vcv", SideTab::vcv}, std::pair{"tab/history", SideTab::history}}) {
    rig.click(name);
    rig.frames();
    CHECK(rig.bench->layout().columns.right_open);
    CHECK(rig.bench->view_control().options().side_tab == tab);
    rig.key(GLFW_KEY_F3);
    CHECK_FALSE(rig.bench->layout().columns.right_open);
  }
}

TEST_CASE("folded columns and the place of the legend are remembered") {
  const TemporaryFolder home;
  {
    Rig rig(1440, 900, home / "profile");
    rig.open(ring_mesh());
    rig.key(GLFW_KEY_F3);
    const auto legend = rig.bench->widgets().find("legend");
    REQUIRE(legend.has_value());
    const Area& v = rig.bench->layout().viewport;
    rig.drag(legend->centre(), ScreenPoint(v.x + 40, v.y + 0.5 * v.height));
    rig.release();
    CHECK(rig.bench->view_control().options().legend_place == LegendPlace::left);
  }
  Rig rig(1440, 900, home / "profile");
  CHECK_FALSE(rig.bench->view_control().options().right_panel);
  CHECK(rig.bench->view_control().options().legend_place == LegendPlace::left);
}

TEST_CASE("the legend stands beside the mesh, and Fit spares it") {
  struct Window {
    int width, height;
    double scale;
  };
  for (const Window& window :
       {Window{1024, 768, 1.0}, {1440, 900, 1.5}, {760, 480, 1.0}, {2560, 1440, 2.0}}) {
    const int width = window.width, height = window.height;
    const double scale = window.scale;
    INFO("width ", width, ", scale ", scale);
    Rig rig(width, height);
    rig.open(two_body_mesh());
    set_view(rig, [&](ViewOptions& view) { view.scale = scale; });
    for (const LegendPlace place : {LegendPlace::right, LegendPlace::left}) {
      set_view(rig, [&](ViewOptions& view) { view.legend_place = place; });
      rig.key(keys::f);
      rig.key(keys::a, {keys::control});  // both bodies have handles
      rig.frames();
      const auto legend = rig.bench->widgets().find("legend");
      REQUIRE(legend.has_value());
      const Coordinates& x = rig.mesh().coordinates;
      for (Index node = 0; node < x.size(); ++node) {
        const ScreenPoint p = rig.pixel(x.xy(node));
        CHECK((p.x() < legend->min.x() || p.x() > legend->max.x()));
      }
      const Gizmo gizmo = rig.gizmo();
      for (const ScreenPoint& p : {gizmo.tips[0], gizmo.tips[1], gizmo.centre})
        CHECK((p.x() < legend->min.x() || p.x() > legend->max.x()));
    }
  }
}

TEST_CASE("the legend is dragged to a corner of the mesh and back to its strip") {
  Rig rig(1440, 900);
  rig.open(ring_mesh());
  const float beside = rig.bench->layout().viewport.width;
  const Vec2 centre = rig.bench->view_control().camera().centre();
  const auto drag_to = [&](double u, double v) {
    const auto legend = rig.bench->widgets().find("legend");
    REQUIRE(legend.has_value());
    const Area& area = rig.bench->layout().viewport;
    const double w = static_cast<double>(area.width), h = static_cast<double>(area.height);
    rig.drag(legend->centre(),
             ScreenPoint(static_cast<double>(area.x) + u * w, static_cast<double>(area.y) + v * h));
    rig.release();
    rig.frames();
    return rig.bench->view_control().options().legend_place;
  };
  CHECK(drag_to(0.2, 0.9) == LegendPlace::bottom_left);
  CHECK(rig.bench->layout().viewport.width > beside + 80);
  CHECK(rig.bench->view_control().camera().centre() == centre);  // nothing was panned
  CHECK(rig.session().selection().empty());
  CHECK(drag_to(0.8, 0.1) == LegendPlace::top_right);
  CHECK(drag_to(0.97, 0.5) == LegendPlace::right);
  CHECK(rig.bench->layout().viewport.width == beside);
  // A press without going anywhere leaves it.
  rig.click("legend");
  CHECK(rig.bench->view_control().options().legend_place == LegendPlace::right);
}

TEST_CASE("a picture of the mesh alone has the legend beside the mesh, as the window does") {
  Rig rig(1440, 900);
  rig.open(ring_mesh());
  const Layout& layout = rig.bench->layout();
  const ScreenVector with = rig.bench->pictures().picture_extent({.size = {}, .panels = false});
  const ScreenVector without =
      rig.bench->pictures().picture_extent({.size = {}, .panels = false, .legend = false});
  CHECK(without.x() == static_cast<double>(layout.viewport.width));
  CHECK(with.x() == static_cast<double>(layout.viewport.width + layout.legend.width));
  const Image picture = rig.bench->pictures().picture({.size = {}, .panels = false});
  CHECK(picture.width == static_cast<int>(with.x()));
}

namespace {

/// Counts how often it is drawn.
RegisteredPanel counter(const char* id, int& count, Region region, MeshKinds serves) {
  return {id, id, region, [&count](const PanelContext&) { ++count; }, {}, all_meshes, serves};
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
  never.shown_for = MeshKinds({});
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
