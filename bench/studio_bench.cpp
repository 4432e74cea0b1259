// The studio on growing meshes, all panels open, without a display (EGL). A table for each:
// - opening, driven as the studio's own loop does: from the click to the first frame on which the
//   whole mesh is drawn, plain; to the first on which it is coloured by quality, with the legend;
//   until nothing is under way any more. By the clock, until the driver is done drawing. What the
//   parser alone takes (text to arrays, the file in memory's cache) is measured before: less that,
//   the times count from the end of parsing;
// - frames at rest, while the solver runs, with the inspector of VCVs and a node under the mouse;
//   of a scrambled mesh, and of one with its inverted elements isolated.
//
//   bench/studio_bench [nodes ...]      default: 15000 200000 500000
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"
#include "gui/shell/workbench/workbench.h"
#include "io/format/mesh_file.h"
#include "io/format/parsed_mesh.h"
#include "io/su2/su2.h"
#include "io/text/source.h"
#include "support/meshes.h"
#include "support/random.h"

namespace {

using namespace winslow;
using namespace winslow::gui;

constexpr int width = 1440;
constexpr int height = 900;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds that this thread has had of a processor: what else runs on the machine does not count.
double spent() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double ms_of(const std::function<void()>& work) {
  const double begin = spent();
  work();
  return 1e3 * (spent() - begin);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// A square with a square hole, its nodes shaken, in a file.
std::filesystem::path write_mesh(long nodes) {
  const auto cells = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(nodes) / 0.96)));
  Mesh mesh = make_mesh(test::square_with_hole(5 * (cells / 5), test::Cells::triangles));
  test::Random random(1);
  const double reach = 0.2 / static_cast<double>(cells);
  for (const Index node : mesh.topology->interior_nodes())
    mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + random.vector(-reach, reach));
  const auto path = std::filesystem::temp_directory_path() /
                    ("winslow-bench-" + std::to_string(getpid()) + ".su2");
  io::write_mesh(path, mesh, nullptr);
  return path;
}

/// Times of one frame, ms of the frame loop's thread. Drawing the same frame again costs the driver
/// as much, but uploads nothing: the difference is what the studio spends on buffers.
struct FrameTimes {
  double update = 0, upload = 0, draw = 0;
  double wall = 0;   ///< of update, by the clock
  double whole = 0;  ///< update and what the frame draws, by the clock
  double own() const { return update + upload; }
};

class Bench {
 public:
  explicit Bench(long nodes) : path_(write_mesh(nodes)) {}
  ~Bench() { std::filesystem::remove(path_); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void run() {
    open();
    report("at rest", frames(40, [] { return true; }));
    inspect();
    bench_.apply(action::RunSmooth{});
    std::vector<FrameTimes> solving =
        frames(4000, [this] { return bench_.session().job().active(); });
    report("solving", solving);
    const std::vector<FrameTimes> after = frames(60, [this] { return !bench_.settled(); });
    solving.insert(solving.end(), after.begin(), after.end());
    const auto& worst = *std::ranges::max_element(solving, {}, &FrameTimes::own);
    double wall = 0;
    for (const FrameTimes& t : solving) wall = std::max(wall, t.wall);
    std::printf(
        "%10s | longest frame: update %.1f, upload %.1f ms; longest update by the clock %.1f ms\n",
        "", worst.update, worst.upload, wall);
    tangled();
  }

 private:
  /// A frame as the studio draws it.
  void plain_frame(double seconds) {
    bench_.update(input_, width, height, seconds);
    buffer_.bind();
    bench_.paint();
    glFinish();
  }

  FrameTimes frame() {
    FrameTimes times;
    input_.move(ScreenPoint(560 + count_ % 40, 250));  // over elements, beside the hole
    if (pressed_ != was_pressed_) input_.button(MouseButton::left, pressed_);
    was_pressed_ = pressed_;
    ++count_;
    const double begin = now();
    times.update = ms_of([&] { bench_.update(input_, width, height, 1.0 / 60); });
    times.wall = 1e3 * (now() - begin);
    const auto paint = [&] {
      buffer_.bind();
      bench_.paint();
      glFinish();
    };
    const double first = ms_of(paint);
    times.whole = 1e3 * (now() - begin);
    bench_.pane().mesh_view().forget_picture();
    times.draw = ms_of(paint);
    times.upload = std::max(first - times.draw, 0.0);
    return times;
  }

  std::vector<FrameTimes> frames(int most, const std::function<bool()>& go_on) {
    std::vector<FrameTimes> all;
    for (int i = 0; i < most && (i == 0 || go_on()); ++i) all.push_back(frame());
    return all;
  }

  void open() {
    const double parsing = parse();
    constexpr double tick = 1.0 / 60;
    const double begin = now();
    double read = 0, plain = 0, coloured = 0, longest = 0;
    bench_.apply(action::OpenMesh{path_});
    do {
      std::this_thread::sleep_for(std::chrono::duration<double>(tick));
      const double from = now();
      plain_frame(tick);
      const double to = now();
      if (bench_.session().document()) {
        longest = std::max(longest, to - from);
        if (read == 0) read = from;
      }
      if (plain == 0 && bench_.pane().mesh_view().has_mesh()) plain = to;
      if (coloured == 0 && bench_.pane().mesh_view().has_colors()) coloured = to;
    } while (!bench_.settled() || coloured == 0);
    const auto& topology = *bench_.session().document()->topology();
    const auto after = [&](double time) { return time - begin - parsing; };
    std::printf(
        "%10d nodes, %d elements: parsed in %.2f s; after that checked and measured %.2f s, drawn "
        "plain %.2f s, coloured %.2f s, settled %.2f s; longest frame %.2f s\n",
        topology.node_count(), topology.element_count(), parsing, after(read), after(plain),
        after(coloured), after(now()), longest);
  }

  double parse() const {
    const double begin = now();
    io::Source source = io::Source::load(path_);
    const io::ParsedMesh parsed = io::su2::format.read(source);
    return now() - begin;
  }

  /// The inspector of VCVs, a node under the mouse and one that was clicked.
  void inspect() {
    const ViewOptions before = bench_.view_control().options();
    ViewOptions view = before;
    view.side_tab = SideTab::vcv;
    bench_.apply(action::EditView{whole(view)});
    std::vector<FrameTimes> times = frames(20, [] { return true; });
    for (const bool down : {true, false}) {
      pressed_ = down;
      times.push_back(frame());
    }
    const std::vector<FrameTimes> after = frames(20, [] { return true; });
    times.insert(times.end(), after.begin(), after.end());
    report("inspecting", times);
    double longest = 0;
    for (const FrameTimes& t : times) longest = std::max(longest, t.wall);
    std::printf("%10s | node %d picked; longest update by the clock %.1f ms\n", "",
                bench_.session().nodes().inspected().value_or(-1), longest);
    bench_.apply(action::EditView{whole(before)});
  }

  /// A mesh that lies over itself thousands of times; with elements isolated, the others are faint.
  void tangled() {
    bench_.apply(action::Scramble{});
    frames(4000, [this] { return !bench_.settled(); });
    report("scrambled", frames(20, [] { return true; }));
    ViewOptions view = bench_.view_control().options();
    view.mark_inverted = false;
    view.isolation.on = true;
    bench_.apply(action::EditView{whole(view)});
    frames(4000, [this] { return !bench_.settled(); });
    report("isolated", frames(20, [] { return true; }));
  }

  static void report(const char* what, const std::vector<FrameTimes>& times) {
    const auto column = [&](auto part, double share) {
      std::vector<double> values;
      for (const FrameTimes& t : times) values.push_back(std::invoke(part, t));
      return quantile(values, share);
    };
    std::printf(
        "%10s | %5zu frames | update %6.2f (95%% %6.2f) | upload %6.2f (95%% %6.2f) | "
        "own %6.2f (95%% %6.2f) | mesh drawn %6.1f | by the clock "
        "%6.1f (95%% %6.1f) ms\n",
        what, times.size(), column(&FrameTimes::update, 0.5), column(&FrameTimes::update, 0.95),
        column(&FrameTimes::upload, 0.5), column(&FrameTimes::upload, 0.95),
        column(&FrameTimes::own, 0.5), column(&FrameTimes::own, 0.95),
        column(&FrameTimes::draw, 0.5), column(&FrameTimes::whole, 0.5),
        column(&FrameTimes::whole, 0.95));
    std::fflush(stdout);
  }

  std::filesystem::path path_;
  std::unique_ptr<HeadlessContext> context_ = make_headless_context();
  Workbench bench_;
  FrameBuffer buffer_{width, height, 4};
  int count_ = 0;
  InputQueue input_;
  bool pressed_ = false;
  bool was_pressed_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<long> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::max(std::atol(argv[i]), 100L));
  if (sizes.empty()) sizes = {15000, 200000, 500000};
  for (const long nodes : sizes) Bench(nodes).run();
  return 0;
}
