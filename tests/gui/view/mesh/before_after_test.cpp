#include <doctest/doctest.h>

#include "core/quality/mesh_change.h"
#include "gui/base/text.h"
#include "gui/panels/quality_panel.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// Two bodies, of which the right one was moved up by 0.3.
void open_and_move(Rig& rig) {
  rig.open(two_body_mesh());
  action::ApplyMotion motion;
  motion.motion = {0, Vec2(2, 0), Vec2(0, 0.3)};
  rig.click("marker/right");
  rig.bench->apply(motion);
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  rig.bench->apply(action::SelectMarkers{});
  rig.bench->apply(action::DismissBanner{});  // the strip would move the mesh in the pictures
  rig.frames();
}

const QualityRow& row(const std::vector<QualityRow>& rows, const std::string& title, int below) {
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k].name == title) return rows[k + static_cast<std::size_t>(below)];
  FAIL("no row " << title);
  return rows.front();
}

}  // namespace

TEST_CASE("the numbers of the table are those of the quality report") {
  const QualityReport before = measure_quality(tangled_mesh());
  const QualityReport now = measure_quality(ring_mesh());
  const auto rows = quality_table(&before, now);
  const auto& min = row(rows, "Normalized Jacobian", 1);
  CHECK(min.name == "min");
  CHECK(min.before == table_number(before.of(Metric::normalized_jacobian).statistics.min));
  CHECK(min.now == table_number(now.of(Metric::normalized_jacobian).statistics.min));
  CHECK(min.verdict == 1);
  CHECK(min.change == "+" + table_number(now.of(Metric::normalized_jacobian).statistics.min -
                                         before.of(Metric::normalized_jacobian).statistics.min));
  CHECK(row(rows, "Aspect ratio", 3).now ==
        table_number(now.of(Metric::aspect_ratio).statistics.max));
  CHECK(row(rows, "Condition number", 2).now ==
        table_number(now.of(Metric::condition_number).statistics.avg));
  const auto& inverted = row(rows, "Inverted", 0);
  CHECK(inverted.before == std::to_string(before.inverted));
  CHECK(inverted.now == "0");
  CHECK(inverted.verdict == 1);
  for (const QualityRow& same : quality_table(&now, now)) {
    CHECK(same.change.empty());
    CHECK(same.verdict == 0);
  }
  CHECK(quality_table(nullptr, now)[1].before == "-");
}

TEST_CASE("an element that cannot move holds the minimum while others move") {
  QualityReport report = measure_quality(ring_mesh());
  QualityReport::PerMetric& sine = report.metrics.front();
  sine.statistics.min = 0.035;
  sine.movable.min = 0.039;
  const auto min_now = [&](double of_movable) {
    const Validity shown{0, of_movable};
    return row(quality_table(&report, report, &shown), "Normalized Jacobian", 1);
  };
  CHECK(min_now(0.039).now == "0.035");
  CHECK(min_now(0.039).change.empty());
  CHECK(min_now(0.5).now == "0.035");
  CHECK(min_now(0.02).now == "0.020");
  sine.movable.min = sine.statistics.min;
  CHECK(min_now(0.5).now == "0.500");
}

TEST_CASE("the table counts what cannot move, and says nothing where nothing was measured") {
  QualityReport now = measure_quality(ring_mesh());
  now.all_on_boundary = 1234;
  CHECK(row(quality_table(nullptr, now), "Cannot move", 0).now == "1,234");
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (auto& metric : now.metrics) metric.statistics = {none, none, none};
  const auto rows = quality_table(&now, now);
  CHECK(row(rows, "Aspect ratio", 3).now == "-");
  CHECK(row(rows, "Aspect ratio", 3).before == "-");
}

TEST_CASE("stretching is not judged: neither green for less of it nor red for more") {
  const QualityReport round = measure_quality(ring_mesh(24, 6));
  const QualityReport flat = measure_quality(ring_mesh(24, 24));
  for (const bool lower : {true, false}) {
    const auto rows = lower ? quality_table(&flat, round) : quality_table(&round, flat);
    int changes = 0;
    for (const char* title : {"Aspect ratio", "Condition number"}) {
      for (const int below : {1, 2, 3}) {
        changes += row(rows, title, below).change.empty() ? 0 : 1;
        CHECK(row(rows, title, below).verdict == 0);
      }
    }
    CHECK(changes >= 3);
  }
}

TEST_CASE("the table of walls has first heights, and node by node over those before") {
  Mesh after = ring_mesh();
  const WallReport before = measure_walls(after);
  REQUIRE(before.walls.size() == 1);
  // All but the far field a little farther out: heights grow, the wall stays.
  for (const Index node : after.topology->interior_nodes())
    after.coordinates.set_xy(node, 1.01 * after.coordinates.xy(node));
  const WallReport now = measure_walls(after);
  const auto rows = wall_table(&before, now);
  const auto number = [](const std::string& text) { return std::stod(text); };
  const auto near = [](double value) { return doctest::Approx(value).epsilon(0.006); };
  CHECK(number(row(rows, "First height", 1).before) == near(before.first_height.min));
  CHECK(number(row(rows, "First height", 5).now) == near(now.first_height.max));
  CHECK(row(rows, "First height", 3).change.starts_with("+"));
  CHECK(row(rows, "First height", 3).verdict == 0);
  const auto change = compare_first_heights(before.walls, now.walls);
  REQUIRE(change);
  CHECK(row(rows, "First height over before", 3).name == "median");
  CHECK(number(row(rows, "First height over before", 3).now) == near(change->ratio.median));
  CHECK(number(row(rows, "First height over before", 6).now) == near(100 * change->off));
  CHECK(row(rows, "First height over before", 6).alarming == spoils_walls(*change));
  CHECK(number(row(rows, "Tilt of the first edge", 2).now) == near(now.tilt.max));
  CHECK(number(row(rows, "Size ratio", 2).now) == near(now.size_ratio.max));
  for (const QualityRow& one : wall_table(nullptr, now)) {
    CHECK(one.name != "First height over before");
    CHECK(one.change.empty());
  }
}

TEST_CASE("before is the mesh as loaded or as it was before the last command") {
  Rig rig(1280, 900);
  open_and_move(rig);
  action::ApplyMotion again;
  again.motion = {0, Vec2(2, 0.3), Vec2(0, 0.2)};
  rig.click("marker/right");
  rig.bench->apply(again);
  REQUIRE(rig.settle());
  const auto min_before = [&] {
    return rig.bench->pane().before().report()->of(Metric::normalized_jacobian).statistics.min;
  };
  CHECK(min_before() ==
        rig.document().loaded_quality().of(Metric::normalized_jacobian).statistics.min);
  rig.click("quality/before");
  rig.click("quality/before/Before last command");
  REQUIRE(rig.settle());
  CHECK(rig.bench->view_control().options().before == BeforeState::last_command);
  const Mesh& between = rig.document().history().state(1).mesh;
  CHECK(*rig.bench->pane().before().coordinates() == between.coordinates);
  REQUIRE(rig.bench->pane().before().report() != nullptr);
  CHECK(min_before() == measure_quality(between).of(Metric::normalized_jacobian).statistics.min);
  rig.key(keys::z, {keys::control});
  REQUIRE(rig.settle());
  rig.frames();
  CHECK(*rig.bench->pane().before().coordinates() ==
        rig.document().history().initial().mesh.coordinates);
}

TEST_CASE("a ghost shows where the edges were") {
  Rig rig;
  open_and_move(rig);
  set_view(rig, [](ViewOptions& view) { view.color.reset(); });
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  const Image plain = rig.bench->pictures().picture();
  rig.key(GLFW_KEY_G);
  REQUIRE(rig.bench->view_control().options().comparison == Comparison::ghost);
  REQUIRE(rig.settle());
  rig.frames();
  const Image ghost = rig.bench->pictures().picture();
  // On an edge of the initial grid near the moved body, and where nothing has moved.
  const Mesh& first = rig.document().history().initial().mesh;
  const Mesh& now = rig.mesh();
  int shown = 0;
  int moved = 0;
  for (const auto& edge : first.topology->edges()) {
    const Vec2 was =
        0.5 * (first.coordinates.xy(edge.nodes[0]) + first.coordinates.xy(edge.nodes[1]));
    const Vec2 is = 0.5 * (now.coordinates.xy(edge.nodes[0]) + now.coordinates.xy(edge.nodes[1]));
    if ((rig.pixel(was) - rig.pixel(is)).norm() < 6 || edge.elements[1] < 0) continue;
    ++moved;
    const ScreenPoint p = rig.pixel(was);
    shown += differing(plain, ghost, p - ScreenVector(1, 1), p + ScreenVector(2, 2)) > 0;
  }
  REQUIRE(moved > 4);
  CHECK(shown > moved * 8 / 10);
  rig.key(GLFW_KEY_G);
  rig.frames();
  CHECK(rig.bench->pictures().picture().rgba == plain.rgba);
}

TEST_CASE("side by side, the mesh before is left of the divider and the mesh now right of it") {
  Rig rig;
  open_and_move(rig);
  set_view(rig, [](ViewOptions& view) { view.legend = false; });
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  const Image now = rig.bench->pictures().picture();
  rig.key(GLFW_KEY_G, {keys::shift});
  REQUIRE(rig.settle());
  rig.frames();
  const Area v = rig.bench->layout().viewport;
  const auto band = [&](double x) {
    return std::pair(ScreenPoint(x - 40, v.y + 40), ScreenPoint(x + 40, v.y + v.height - 10));
  };
  // The moved body, under the divider's right side and then under its left.
  const double body = rig.pixel(Vec2(2, 0)).x();
  const auto [min, max] = band(body);
  REQUIRE(rig.visible("splitter/compare"));
  CHECK(differing(now, rig.bench->pictures().picture(), min, max) == 0);
  const ScreenPoint grip = rig.bench->widgets().find("splitter/compare")->centre();
  rig.drag(grip, ScreenPoint(body + 90, grip.y()));
  rig.release();
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  CHECK(rig.bench->view_control().options().divider > 0.6);
  CHECK(differing(now, rig.bench->pictures().picture(), min, max) > 300);
  rig.bench->apply(action::Undo{});
  REQUIRE(rig.settle());
  set_view(rig, [](ViewOptions& view) { view.comparison = Comparison::none; });
  const Image first = rig.bench->pictures().picture();
  rig.bench->apply(action::Redo{});
  rig.bench->apply(action::DismissBanner{});
  set_view(rig, [](ViewOptions& view) { view.comparison = Comparison::split; });
  rig.move(ScreenPoint(5, 5));
  rig.frames();
  CHECK(differing(first, rig.bench->pictures().picture(), min, max) < 40);
}

}  // namespace winslow::gui::test
