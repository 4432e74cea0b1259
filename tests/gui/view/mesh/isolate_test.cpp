#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "gui/support/pixels.h"
#include "gui/support/rig.h"
#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui::test {

namespace {

Vec2 centre_of(const Mesh& mesh, Index element) {
  Vec2 sum(0, 0);
  for (const Index node : mesh.topology->element(element)) sum += mesh.coordinates.xy(node);
  return sum / static_cast<double>(mesh.topology->element(element).size());
}

/// A value that as many elements lie below as above.
double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return 0.5 * (values[half - 1] + values[half]);
}

}  // namespace

TEST_CASE("isolated elements stay, the others fade or go") {
  Rig rig;
  rig.open(ring_mesh());
  set_view(rig, [](ViewOptions& view) { view.legend = false; });
  const auto values = rig.session().quality().latest()->values;
  const double threshold = median(values);
  const Image all = rig.bench->pictures().picture();
  const auto check = [&](double rest, double others) {
    set_view(rig, [&](ViewOptions& view) {
      view.isolation.on = true;
      view.isolation.threshold = threshold;
      view.isolation.rest = rest;
    });
    const Image some = rig.bench->pictures().picture();
    int kept = 0;
    int faded = 0;
    for (Index e = 0; e < rig.mesh().topology->element_count(); e += 3) {
      const ScreenPoint p = rig.pixel(centre_of(rig.mesh(), e));
      const double difference = std::abs(brightness(some, p) - brightness(all, p));
      // Small ones are covered by the edges of their neighbours.
      if (values[static_cast<std::size_t>(e)] < threshold)
        kept += difference < 0.02;
      else
        faded += std::abs(brightness(some, p) - (1 - others * (1 - brightness(all, p)))) < 0.06;
    }
    const auto half = static_cast<int>(values.size() / 6);
    CHECK(kept > half * 8 / 10);
    CHECK(faded > half * 8 / 10);
  };
  check(0, 0);
  check(0.3, 0.3);
}

TEST_CASE("isolation counts on either side, and leaves alone what has no value") {
  const std::vector<double> values{0.1, 0.4, 0.5, 0.9, std::nan("")};
  Isolation isolation;
  isolation.on = true;
  isolation.threshold = 0.5;
  CHECK(isolated_count(values, isolation) == 2);
  isolation.above = true;
  CHECK(isolated_count(values, isolation) == 1);
  isolation.rest = 0.25;
  CHECK(element_opacity(values, isolation) == std::vector<float>{0.25f, 0.25f, 0.25f, 1, 0.25f});
  isolation.on = false;
  CHECK(element_opacity(values, isolation).empty());
}

TEST_CASE("the threshold is dragged in the legend, without the mesh moving") {
  Rig rig;
  rig.open(ring_mesh());
  rig.key(GLFW_KEY_I);
  REQUIRE(rig.bench->view_control().options().isolation.on);
  rig.frames();
  const auto bars = rig.bench->widgets().find("legend/bars");
  REQUIRE(bars.has_value());
  const Vec2 centre = rig.bench->view_control().camera().centre();
  const double height = bars->max.y() - bars->min.y();
  const ScreenPoint from(bars->centre().x(), bars->max.y() - 0.5 * height);
  rig.drag(from, ScreenPoint(bars->centre().x(), bars->max.y() - 0.8 * height));
  rig.release();
  CHECK(rig.bench->view_control().options().isolation.threshold ==
        doctest::Approx(0.8).epsilon(0.03));
  CHECK(rig.bench->view_control().camera().centre() == centre);
  CHECK(rig.session().selection().empty());
}

TEST_CASE("colouring by another metric isolates its bad side") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  rig.key(GLFW_KEY_I);
  rig.click("tab/view");
  rig.click("view/color");
  rig.click("view/color/" + std::string(metric_label(Metric::aspect_ratio)));
  CHECK(rig.bench->view_control().options().isolation.on);
  CHECK(rig.bench->view_control().options().isolation.above);
  CHECK(rig.bench->view_control().options().isolation.threshold > 1);
}

TEST_CASE("ids are shown where they fit, and nowhere else") {
  Rig rig;
  rig.open(two_body_mesh());
  const auto count = [&](const std::string& kind) {
    return std::ranges::count_if(rig.bench->widgets().all(), [&](const auto& entry) {
      return entry.first.starts_with("id/" + kind) && entry.first != "id/none";
    });
  };
  CHECK(count("n") + count("e") == 0);
  rig.key(GLFW_KEY_I, {keys::shift});
  rig.key(GLFW_KEY_E, {keys::shift});
  REQUIRE(rig.bench->view_control().options().node_ids);
  REQUIRE(rig.bench->view_control().options().element_ids);
  const ScreenPoint at = rig.pixel(Vec2(-0.3, 0.4));
  rig.wheel(at, 6);
  rig.frames();
  CHECK(count("e") > 0);
  CHECK(count("n") > 0);
  CHECK(count("e") < 60);
  // None outside the viewport; of elements none over another, of whatever kind.
  const Area v = rig.bench->layout().viewport;
  std::vector<WidgetMap::Rect> boxes;
  for (const auto& [name, rect] : rig.bench->widgets().all())
    if (name.starts_with("id/n") && name != "id/none") boxes.push_back(rect);
  for (const auto& [name, rect] : rig.bench->widgets().all()) {
    if (!name.starts_with("id/e")) continue;
    CHECK(rect.centre().x() >= v.x);
    CHECK(rect.centre().y() <= v.y + v.height);
    for (const auto& other : boxes) CHECK(apart(rect, other));
    boxes.push_back(rect);
  }
  rig.key(keys::f);
  rig.wheel(at, -12);
  rig.frames();
  CHECK(count("n") + count("e") == 0);
  CHECK(rig.visible("id/none"));
}

TEST_CASE("the boundary's nodes and directions are drawn along it") {
  Rig rig;
  rig.open(ring_mesh());
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  const Image plain = rig.bench->pictures().picture();
  const ScreenPoint node = rig.pixel(rig.mesh().coordinates.xy(0));
  set_view(rig, [](ViewOptions& view) { view.rim_nodes = true; });
  CHECK(differing(plain, rig.bench->pictures().picture(), node - ScreenVector(5, 5),
                  node + ScreenVector(5, 5)) > 10);
  set_view(rig, [](ViewOptions& view) {
    view.rim_nodes = false;
    view.directions = true;
  });
  const ScreenPoint origin = rig.pixel(Vec2(0, 0));
  CHECK(differing(plain, rig.bench->pictures().picture(), origin - ScreenVector(200, 100),
                  origin + ScreenVector(200, 100)) > 20);
}

TEST_CASE("bands and a fixed range are those of the legend and of the mesh") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  const auto colors = [&] {
    const auto bar = rig.bench->widgets().find("legend/bars");
    REQUIRE(bar.has_value());
    std::set<std::array<int, 3>> found;
    const Image image = rig.bench->pictures().picture();
    const auto x = static_cast<int>(bar->min.x()) + 6;
    for (int y = static_cast<int>(bar->min.y()) + 3; y < static_cast<int>(bar->max.y()) - 3; ++y) {
      const auto* p = image.pixel(x, y);
      found.insert({p[0], p[1], p[2]});
    }
    return found.size();
  };
  CHECK(colors() > 60);
  rig.click("tab/view");
  rig.click("view/bands");
  rig.click("view/bands/5 bands");
  REQUIRE(rig.settle());
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  CHECK(rig.bench->view_control().options().bands == 5);
  // Five, and what smoothing makes of their borders.
  CHECK(colors() <= 10);
  const ScreenPoint at = rig.pixel(centre_of(rig.mesh(), 60));
  const double before = brightness(rig.bench->pictures().picture(), at);
  rig.click("view/range");
  rig.click("view/range/From value to value");
  // It begins where the colours are.
  REQUIRE(rig.bench->view_control().options().range.has_value());
  CHECK((*rig.bench->view_control().options().range)[1] == 1);
  rig.fill("view/range_low", "0.95");
  rig.fill("view/range_high", "0.99");
  REQUIRE(rig.settle());
  rig.frames();
  REQUIRE(rig.bench->view_control().options().range.has_value());
  CHECK((*rig.bench->view_control().options().range)[0] == 0.95);
  // Everything is below the range: the dark end.
  CHECK(brightness(rig.bench->pictures().picture(), at) < before - 0.1);
}

}  // namespace winslow::gui::test
