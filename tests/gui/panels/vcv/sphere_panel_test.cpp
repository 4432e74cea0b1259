#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "gui/panels/vcv/sphere_plot.h"
#include "gui/support/pixels.h"
#include "gui/support/vcv_rig.h"

namespace winslow::gui::test {

TEST_CASE("sphere inspector: a typed node shows star and VCV; one of the boundary says why not") {
  SphereStudio studio;
  CHECK(studio.visible("vcv/hint"));
  studio.enter_node(std::to_string(studio.inner()));
  CHECK(studio.session().nodes().inspected() == studio.inner());
  for (const char* id : {"vcv/star", "vcv/plot", "vcv/angle_legend", "vcv/kind", "vcv/angles",
                         "vcv/singular", "vcv/kappa", "vcv/smallest", "vcv/residual"})
    CHECK_MESSAGE(studio.visible(id), id);
  const VolumeNodalView& view = studio.view(studio.inner());
  CHECK(studio.front_points(studio.inner()).size() >= 3);
  CHECK(studio.front_points(studio.inner()).size() < view.neighbours.size());
  studio.enter_node("0");  // a corner of the cube
  CHECK(studio.visible("vcv/none"));
  CHECK_FALSE(studio.visible("vcv/plot"));
}

TEST_CASE("sphere inspector: a click on a node of a cut inspects it while the tab is open") {
  SphereStudio studio;
  // A cut through the middle, whole elements behind it, seen from its side.
  set_view(studio, [](ViewOptions& view) {
    CutPlane cut;
    cut.point = {0.5, 0.5, 0.5};
    cut.normal = {1, 0, 0};
    view.space.cuts = {cut};
    view.space.crinkle = true;
  });
  studio.key(GLFW_KEY_1);
  studio.frames(2);
  const SpaceCamera& seen = studio.bench->view_control().space().view();
  const Topology& topology = *studio.mesh().topology;
  Index found = -1;
  for (const Index node : topology.interior_nodes()) {
    const ScreenPoint at = seen.project(studio.mesh().coordinates.xyz(node)).at;
    studio.move(at + ScreenVector(2, 1));
    studio.frames(1);
    const auto& place = studio.bench->view_control().state().seen;
    if (!place || place->node != node) continue;
    found = node;
    CHECK(studio.session().nodes().hovered() == node);
    studio.click(at + ScreenVector(2, 1));
    break;
  }
  REQUIRE(found >= 0);
  studio.frames(2);
  CHECK(studio.session().nodes().inspected() == found);
  CHECK(studio.visible("vcv/plot"));
  CHECK(studio.session().selection().empty());
}

TEST_CASE("sphere inspector: Alt and a click open the tab from another one") {
  SphereStudio studio;
  studio.click("tab/quality");
  set_view(studio, [](ViewOptions& view) {
    CutPlane cut;
    cut.point = {0.5, 0.5, 0.5};
    cut.normal = {1, 0, 0};
    view.space.cuts = {cut};
    view.space.crinkle = true;
  });
  studio.key(GLFW_KEY_1);
  studio.frames(2);
  const SpaceCamera& seen = studio.bench->view_control().space().view();
  for (const Index node : studio.mesh().topology->interior_nodes()) {
    const ScreenPoint at = seen.project(studio.mesh().coordinates.xyz(node)).at;
    studio.move(at);
    studio.frames(1);
    const auto& place = studio.bench->view_control().state().seen;
    if (!place || place->node != node) continue;
    studio.click(at);
    CHECK_FALSE(studio.session().nodes().inspected().has_value());
    studio.input.key(keys::alt, true);
    studio.click(at);
    studio.input.key(keys::alt, false);
    studio.frames(2);
    CHECK(studio.session().nodes().inspected() == node);
    CHECK(studio.bench->view_control().options().side_tab == SideTab::vcv);
    return;
  }
  FAIL("no node is seen");
}

TEST_CASE("sphere inspector: dragging beside the points turns both pictures, or one of them") {
  SphereStudio studio;
  studio.inspect(studio.inner());
  const auto ends = [&](const std::string& of) {
    std::set<std::size_t> front;
    for (std::size_t k = 0; k < 30; ++k)
      if (studio.visible(of + "/end/" + std::to_string(k))) front.insert(k);
    return front;
  };
  const auto star = ends("vcv/star"), vcv = ends("vcv");
  const WidgetMap::Rect plot = studio.rect("vcv/star");
  const ScreenPoint corner = plot.min + ScreenVector(8, plot.max.y() - plot.min.y() - 8);
  studio.drag(corner, corner + ScreenVector(0.8 * (plot.max.x() - plot.min.x()), -20));
  studio.release();
  studio.frames(2);
  CHECK(ends("vcv/star") != star);
  CHECK(ends("vcv") != vcv);
  // Free of each other: the star alone.
  studio.click("vcv/linked");
  const auto turned = ends("vcv/star"), stays = ends("vcv");
  studio.drag(corner, corner + ScreenVector(0.6 * (plot.max.x() - plot.min.x()), -10));
  studio.release();
  studio.frames(2);
  CHECK(ends("vcv/star") != turned);
  CHECK(ends("vcv") == stays);
  CHECK_FALSE(studio.session().job().active());
}

TEST_CASE("sphere inspector: both look from where the mesh is looked at, if asked") {
  SphereStudio studio;
  studio.inspect(studio.inner());
  const auto where = [&] {
    std::vector<ScreenPoint> places;
    for (const std::size_t k : studio.front_points(studio.inner()))
      places.push_back(studio.middle("vcv/end/" + std::to_string(k)));
    return places;
  };
  const auto first = where();  // as the mesh was seen when the node was inspected
  const WidgetMap::Rect plot = studio.rect("vcv/star");
  const ScreenPoint corner = plot.min + ScreenVector(8, 30);
  studio.drag(corner, corner + ScreenVector(60, 20));
  studio.release();
  studio.frames(2);
  CHECK(where() != first);
  studio.click("vcv/as_mesh");
  studio.frames(2);
  const auto again = where();
  REQUIRE(again.size() == first.size());
  for (std::size_t k = 0; k < first.size(); ++k) CHECK((again[k] - first[k]).norm() < 1);
}

TEST_CASE("sphere inspector: numbers stand only where they are legible, and nowhere over another") {
  SphereStudio studio;
  const Index node = studio.inner();
  studio.inspect(node);
  const std::size_t faces = studio.view(node).targets.size();
  const std::size_t edges = studio.view(node).neighbours.size();
  const auto rects = [&](const std::string& prefix, std::size_t most) {
    std::vector<WidgetMap::Rect> found;
    for (std::size_t k = 0; k < most; ++k)
      if (const auto r = studio.bench->widgets().find(prefix + std::to_string(k)))
        found.push_back(*r);
    return found;
  };
  const auto check_apart = [&] {
    std::vector<WidgetMap::Rect> labels = rects("vcv/angle/", faces);
    for (const WidgetMap::Rect& weight : rects("vcv/weight/", edges)) labels.push_back(weight);
    const auto discs = rects("vcv/end/", edges);
    const WidgetMap::Rect plot = studio.rect("vcv/plot");
    for (std::size_t a = 0; a < labels.size(); ++a) {
      CHECK(labels[a].min.x() >= plot.min.x() - 1);
      CHECK(labels[a].max.x() <= plot.max.x() + 1);
      for (std::size_t b = 0; b < a; ++b) CHECK(apart(labels[a], labels[b]));
      for (const WidgetMap::Rect& disc : discs) CHECK(apart(labels[a], disc));
    }
    return labels.size();
  };
  const int small = studio.count("vcv/angle/", faces);
  check_apart();
  studio.click("vcv/large");
  studio.frames(2);
  CHECK(studio.count("vcv/angle/", faces) > small);
  CHECK(check_apart() > 3);
}

TEST_CASE("sphere inspector: tables name every edge and face, and light them up") {
  SphereStudio studio(1300, 1300);
  const Index node = studio.inner();
  studio.inspect(node);
  REQUIRE(studio.visible("vcv/row/0"));
  studio.move(ScreenPoint(3, 3));
  studio.frames(2);
  const WidgetMap::Rect plot = studio.rect("vcv/plot");
  const Image plain = studio.bench->pictures().picture();
  studio.move(studio.middle("vcv/row/2"));
  studio.frames(2);
  CHECK(differing(plain, studio.bench->pictures().picture(), plot.min, plot.max) > 20);
  studio.click("vcv/figures/faces");
  studio.frames(2);
  REQUIRE(studio.visible("vcv/face/0"));
  studio.move(ScreenPoint(3, 3));
  studio.frames(2);
  const Image faces = studio.bench->pictures().picture();
  studio.move(studio.middle("vcv/face/1"));
  studio.frames(2);
  CHECK(differing(faces, studio.bench->pictures().picture(), plot.min, plot.max) > 20);
}

TEST_CASE("sphere inspector: the kind of VCVs is the solver's, and changes what is shown") {
  SphereStudio studio;
  const Index node = studio.inner();
  studio.inspect(node);
  const auto spread = [&] {
    const auto [low, high] = std::ranges::minmax(studio.view(node).vcv.solid_angles);
    return high / low;
  };
  const double adjusted = spread();
  CHECK(adjusted > 1.2);
  studio.click("vcv/kind");
  studio.frames(2);
  studio.click("vcv/kind/Equal angles");
  studio.frames(2);
  CHECK(studio.session().solver_settings().smooth_options().vcv == VcvKind::equal);
  CHECK(spread() < 1.01);
  CHECK(studio.view(node).largest_error < 2e-3);
}

TEST_CASE("sphere inspector: colours of star and VCV are of one scale, around the equal angle") {
  SphereStudio studio;
  const VolumeNodalView& view = studio.view(studio.inner());
  const ColorScale scale = SpherePlot::colors_of(view);
  const double equal = 4 * pi / view.link.triangle_count();
  CHECK(scale.low < equal);
  CHECK(scale.high > equal);
  for (const double angle : view.physical.solid_angles) {
    CHECK(angle >= scale.low);
    CHECK(angle <= scale.high);
  }
}

TEST_CASE("sphere inspector: it follows the mesh through undo and another mesh") {
  SphereStudio studio;
  const Index node = studio.inner();
  studio.inspect(node);
  const double residual = studio.view(node).scaled_residual;
  studio.bench->apply(action::RunSmooth{});
  REQUIRE(studio.settle());
  studio.frames(2);
  CHECK(studio.view(node).scaled_residual < 0.5 * residual);
  studio.bench->apply(action::Undo{});
  studio.frames(2);
  CHECK(studio.view(node).scaled_residual == doctest::Approx(residual));
  // A plane mesh has the plane's panel, and the inspector none of the other mesh's nodes.
  studio.open(two_body_mesh(), "plane.su2");
  studio.frames(2);
  CHECK_FALSE(studio.session().in_space());
  CHECK(studio.visible("vcv/hint"));
}

}  // namespace winslow::gui::test
