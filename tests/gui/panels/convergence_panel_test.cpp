#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"
#include "gui/widgets/plot_frame.h"

namespace winslow::gui::test {

namespace {

/// Pixels within the plot that are nearly of a colour.
int count_of(const Rig& rig, const Image& image, ImU32 color) {
  const auto plot = rig.bench->widgets().find("convergence/plot");
  REQUIRE(plot.has_value());
  const auto near = [&](std::uint8_t value, int shift) {
    return std::abs(static_cast<int>(value) - static_cast<int>((color >> shift) & 0xff)) < 40;
  };
  int count = 0;
  for (int y = static_cast<int>(plot->min.y()) + 8; y < static_cast<int>(plot->max.y()) - 37; ++y)
    for (int x = static_cast<int>(plot->min.x()) + 56; x < static_cast<int>(plot->max.x()) - 50;
         ++x) {
      const std::uint8_t* c = image.pixel(x, y);
      count += near(c[0], IM_COL32_R_SHIFT) && near(c[1], IM_COL32_G_SHIFT) &&
               near(c[2], IM_COL32_B_SHIFT);
    }
  return count;
}

/// A run that begins tangled, so that every curve has something to show.
void run_tangled(Rig& rig) {
  rig.open(ring_mesh());
  rig.bench->apply(action::Scramble{3});
  REQUIRE(rig.settle());
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  rig.move(ScreenPoint(2, 2));
  rig.frames(3);
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("each entry of the key shows and hides its curve") {
  Rig rig(1300, 900);
  run_tangled(rig);
  struct Series {
    const char* id;
    ImU32 color;
  };
  for (const Series& series : {Series{"convergence/residual", palette().accent},
                               Series{"convergence/move", palette().move_line},
                               Series{"convergence/sine", palette().warning}}) {
    INFO(series.id);
    CHECK(count_of(rig, rig.bench->pictures().picture(), series.color) > 20);
    rig.click(series.id);
    rig.move(ScreenPoint(2, 2));
    rig.frames(3);
    CHECK(count_of(rig, rig.bench->pictures().picture(), series.color) < 5);
  }
  const Image with = rig.bench->pictures().picture();
  rig.click("convergence/inverted");
  rig.move(ScreenPoint(2, 2));
  rig.frames(3);
  CHECK(rig.bench->pictures().picture().rgba != with.rgba);
  rig.click("convergence/residual");
  rig.move(ScreenPoint(2, 2));
  rig.frames(3);
  CHECK(count_of(rig, rig.bench->pictures().picture(), palette().accent) > 20);
}

TEST_CASE("the CSV export holds every iteration shown, to the bit, and asks before it replaces") {
  Rig rig(1300, 900);
  run_tangled(rig);
  const auto path = rig.folder / "run.csv";
  rig.click("convergence/export");
  REQUIRE(rig.bench->dialogs().file_dialog().is_open());
  rig.fill("dialog/name", path.string());
  rig.click("dialog/accept");
  REQUIRE(rig.settle());
  const std::vector<std::string> lines = lines_of(path);
  const auto records = rig.session().mesh().convergence();
  REQUIRE(lines.size() == records.size() + 1);
  CHECK(lines[0] ==
        "iteration,residual,largest_move,inverted,min_sine,damping,clipped,linear_iterations,"
        "fraction,command,stage");
  for (std::size_t k = 0; k < records.size(); ++k) {
    std::istringstream row(lines[k + 1]);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    REQUIRE(cells.size() == 11);
    CHECK(std::stoi(cells[0]) == records[k].iteration);
    CHECK(std::stod(cells[1]) == records[k].residual);
    CHECK(std::stoi(cells[3]) == records[k].inverted);
    CHECK(std::stod(cells[4]) == records[k].min_sine);
    CHECK(cells[9] == "2");
  }
  std::ofstream(path) << "mine";
  rig.bench->apply(action::ExportConvergence{path});
  rig.frames();
  REQUIRE(rig.visible("prompt/Replace"));
  rig.click("prompt/Cancel");
  CHECK(lines_of(path) == std::vector<std::string>{"mine"});
  rig.bench->apply(action::ExportConvergence{path});
  rig.frames();
  rig.click("prompt/Replace");
  REQUIRE(rig.settle());
  CHECK(lines_of(path) == lines);
}

TEST_CASE("the readout follows the mouse from iteration to iteration") {
  Rig rig(1300, 900);
  run_tangled(rig);
  const auto plot = rig.bench->widgets().find("convergence/plot");
  const Image away = rig.bench->pictures().picture();
  rig.move(ScreenPoint(plot->min.x() + 80, plot->centre().y()));
  rig.frames(3);
  const Image left = rig.bench->pictures().picture();
  rig.move(ScreenPoint(plot->max.x() - 80, plot->centre().y()));
  rig.frames(3);
  CHECK(left.rgba != away.rgba);
  CHECK(rig.bench->pictures().picture().rgba != left.rgba);
}

TEST_CASE("thousands of points become a few for each column of pixels, peaks kept") {
  std::vector<ImVec2> points;
  for (int i = 0; i < 20000; ++i)
    points.emplace_back(static_cast<float>(i) * 0.02f,
                        i == 7777 ? 500.0f : static_cast<float>(i % 7));
  const std::vector<ImVec2> kept = decimated(points);
  CHECK(kept.size() <= 4 * 401);
  CHECK(kept.size() > 400);
  CHECK(std::any_of(kept.begin(), kept.end(), [](const ImVec2& p) { return p.y == 500.0f; }));
  CHECK(kept.front().x == points.front().x);
  CHECK(kept.back().x == points.back().x);
  CHECK(std::is_sorted(kept.begin(), kept.end(),
                       [](const ImVec2& a, const ImVec2& b) { return a.x < b.x; }));
  CHECK(decimated({}).empty());
}

TEST_CASE("the axes hold what they are to show") {
  std::vector<IterationRecord> history(3);
  history[0].residual = 2e3;
  history[1].residual = 3e-7;
  history[1].inverted = 41;
  history[1].min_sine = -0.7;
  history[2].min_sine = 0.55;
  const PlotAxis values = residual_axis(history, 1e-10, true, true);
  CHECK(values.share(2e3) < 1);
  CHECK(values.share(1e-10) > 0);
  CHECK(values.share(2e3) > values.share(3e-7));
  CHECK(inverted_axis(history).share(41) <= 1);
  CHECK(inverted_axis(history).share(0) == 0);
  const PlotAxis sines = sine_axis(history);
  CHECK(sines.share(-0.7) >= 0);
  CHECK(sines.share(0.55) > sines.share(0));
  CHECK(sine_axis({}).high > sine_axis({}).low);
}

TEST_CASE("a logarithmic axis names at least two decades, however low the plot") {
  for (const double low : {-12.0, -7.0, -3.0, -1.0})
    for (const double high : {0.0, 2.0, 5.0})
      for (const int wanted : {1, 2, 3, 6}) {
        CAPTURE(low);
        CAPTURE(high);
        CAPTURE(wanted);
        const std::vector<int> named = named_decades({low, high, true}, wanted);
        CHECK(named.size() >= 2);
        CHECK(named.size() <= static_cast<std::size_t>(std::max(wanted, 2)));
        CHECK(named.front() == low);
        CHECK(named.back() <= high);
      }
}

TEST_CASE("the plot survives numbers that no run should have") {
  Rig rig;
  rig.open(ring_mesh());
  std::vector<IterationRecord> history(2);
  history[0].residual = HUGE_VAL;
  history[1].residual = std::nan("");
  for (const double tolerance : {1e-300, 1e300, HUGE_VAL}) {
    const PlotAxis axis = residual_axis(history, tolerance, true, true);
    CHECK(std::isfinite(axis.share(tolerance)));
    CHECK(axis.high > axis.low);
    CHECK(named_decades(axis, 3).size() >= 2);
    SmoothOptions odd;
    odd.tolerance = tolerance;
    rig.bench->apply(action::EditSmoothOptions{whole(odd)});
    rig.frames();
    CHECK(rig.visible("convergence/strip"));
  }
}

TEST_CASE("while there is nothing to plot its place is a strip, and the mesh has the room") {
  Rig rig(1300, 900);
  rig.open(ring_mesh());
  CHECK(rig.visible("convergence/strip"));
  CHECK_FALSE(rig.visible("convergence/plot"));
  const float wide = rig.bench->layout().viewport.height;
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(rig.visible("convergence/plot"));
  CHECK_FALSE(rig.visible("convergence/strip"));
  const float narrow = rig.bench->layout().viewport.height;
  CHECK(narrow < wide - 100);
  // Undoing makes the mesh jump no more.
  rig.bench->apply(action::Undo{});
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(rig.bench->layout().viewport.height == narrow);
}

TEST_CASE("nothing but curves and dashes is drawn within the plot's frame") {
  Rig rig(1300, 900);
  run_tangled(rig);
  for (const char* id :
       {"convergence/residual", "convergence/move", "convergence/sine", "convergence/inverted"})
    rig.click(id);
  rig.move(ScreenPoint(2, 2));
  rig.frames(3);
  // The name of the tolerance would take more than its dashes do.
  const auto plot = rig.bench->widgets().find("convergence/plot");
  CHECK(count_of(rig, rig.bench->pictures().picture(), palette().success) <
        static_cast<int>(1.6 * (plot->max.x() - plot->min.x())));
}

}  // namespace winslow::gui::test
