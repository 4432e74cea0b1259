// The studio on volume meshes, all panels open, without a display (EGL): how long a mesh takes to
// be in the picture, what frames cost at rest, while the view is turned and while a body is moved
// by the solver, and how long a cut that is dragged takes to be in the picture. Times of frames are
// those of the window's thread alone.
//
//   bench/space_studio_bench [--open] MESH ...     --open: nothing else
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"
#include "gui/shell/workbench/workbench.h"
#include "io/format/mesh_format.h"

namespace {

using namespace winslow;
using namespace winslow::gui;

constexpr int width = 1440, height = 900;

double clock_ms() {
  return 1e3 *
         std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Milliseconds that this thread has had of a processor: what else runs does not count.
double spent_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// The same of all threads of the process.
double spent_by_all_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// The same of the threads beside this one.
double spent_beside_ms() { return spent_by_all_ms() - spent_ms(); }

void report(const char* what, std::vector<double> values) {
  std::ranges::sort(values);
  std::printf("  %-34s median %7.2f, 99 %% %7.2f, longest %7.2f ms\n", what,
              values[values.size() / 2], values[values.size() * 99 / 100], values.back());
  std::fflush(stdout);
}

class SpaceBench {
 public:
  explicit SpaceBench(const char* mesh) {
    const Times parsing = parse(mesh);
    const Times begin = Times::now();
    const auto since = [&] {
      const Times now = Times::now();
      return Times{now.clock - begin.clock - parsing.clock,
                   now.spent - begin.spent - parsing.spent};
    };
    std::optional<Times> checked, shown;
    bench_.apply(action::OpenMesh{mesh});
    for (int quiet = 0; quiet < 4; quiet = bench_.settled() ? quiet + 1 : 0) {
      frame();
      if (!checked && bench_.session().document()) checked = since();
      // Painted once: the processor's painting would take the time of the threads behind it.
      if (!shown && bench_.pane().mesh_view().volume().scenes()) {
        paint();
        shown = since();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const Times all = since();
    const auto& topology = *bench_.session().topology();
    std::printf("%s: %d nodes, %d elements\n", mesh, static_cast<int>(topology.node_count()),
                static_cast<int>(topology.element_count()));
    const auto report_time = [](const char* what, const Times& time) {
      std::printf("  %-34s %7.2f s by the clock, %7.2f s of CPU time\n", what, 1e-3 * time.clock,
                  1e-3 * time.spent);
    };
    std::printf("  parsing takes %.2f s by the clock, %.2f s of CPU time; from its end:\n",
                1e-3 * parsing.clock, 1e-3 * parsing.spent);
    report_time("checked, its quality measured", *checked);
    report_time("in the picture", *shown);
    report_time("coloured, and all else done", all);
  }

  void run() {
    at_rest();
    turn();
    drag_cut();
    solve();
  }

 private:
  struct Times {
    double clock, spent;  // ms
    static Times now() { return {clock_ms(), spent_by_all_ms()}; }
  };
  static Times parse(const char* mesh) {
    const Times begin = Times::now();
    io::Source source = io::Source::load(mesh);
    const io::MeshFormat* format = io::format_of_extension(mesh);
    if (format) format->read(source);
    const Times end = Times::now();
    return {end.clock - begin.clock, end.spent - begin.spent};
  }

  double frame() {
    const double begin = spent_ms();
    bench_.update(input_, width, height, 1.0 / 60);
    return spent_ms() - begin;
  }
  /// The driver's work, which a graphics card does.
  double paint() {
    const double begin = spent_ms();
    buffer_.bind();
    bench_.paint();
    glFinish();
    return spent_ms() - begin;
  }
  void settle() {
    for (int quiet = 0; quiet < 4; quiet = bench_.settled() ? quiet + 1 : 0) {
      frame();
      paint();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  void at_rest() {
    std::vector<double> update, drawn;
    for (int k = 0; k < 60; ++k) {
      input_.move(ScreenPoint(560 + k % 40, 350));
      update.push_back(frame());
      drawn.push_back(paint());
    }
    report("mouse moves, update", update);
    report("mouse moves, drawn (kept picture)", drawn);
  }

  void turn() {
    std::vector<double> update, drawn;
    input_.move(ScreenPoint(600, 400));
    frame();
    input_.button(MouseButton::left, true);
    for (int k = 0; k < 30; ++k) {
      input_.move(ScreenPoint(600 + 4 * k, 400 + k));
      update.push_back(frame());
      drawn.push_back(paint());
    }
    input_.button(MouseButton::left, false);
    frame();
    report("turning, update", update);
    report("turning, drawn by the processor", drawn);
  }

  void drag_cut() {
    std::vector<double> answer, beside, update;
    for (int k = 0; k < 20; ++k) {
      ViewOptions view = bench_.view_control().options();
      if (view.space.cuts.empty()) return;
      view.space.cuts[0].point[1] += 0.004;
      const auto before = bench_.pane().mesh_view().volume().scenes();
      glFinish();  // the driver has threads, too
      const double begin = clock_ms(), begin_beside = spent_beside_ms();
      bench_.apply(action::EditView{whole(view)});
      while (bench_.pane().mesh_view().volume().scenes() == before) {
        update.push_back(frame());
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      }
      answer.push_back(clock_ms() - begin);
      beside.push_back(spent_beside_ms() - begin_beside);
      paint();
    }
    report("a cut moves, until its section", answer);
    report("the same, work of its threads", beside);
    report("frames meanwhile, update", update);
  }

  /// The first marker that does not enclose the others.
  std::optional<Index> body() const {
    const VolumeBoundary& boundary = *bench_.session().document()->boundary();
    for (std::size_t f = 0; f < boundary.faces.size(); ++f)
      if (boundary.enclosing[f] == 0 && boundary.faces[f].marker >= 0)
        return boundary.faces[f].marker;
    return std::nullopt;
  }

  /// Frames at 60 a second while a body goes to its place, for at most so many of them.
  void solve() {
    constexpr int most = 900;
    const auto marker = body();
    if (!marker) return;
    bench_.apply(action::SelectMarkers{{*marker}});
    settle();
    RigidMotion motion;
    motion.rotate = 25;
    motion.pivot = bench_.session().selection().space_pivot();
    motion.translate = Vec3(0, 0, 0);
    motion.axis = Vec3(0, 0, 1);
    const double before_start = spent_ms();
    bench_.apply(action::ApplyMotion{motion});
    const double start = spent_ms() - before_start;
    std::vector<double> update, drawn;
    std::uint64_t meshes = 0, shape = bench_.session().shape();
    double beside = -spent_beside_ms();
    const double begin = clock_ms();
    for (int k = 0; k < most && bench_.session().in_motion(); ++k) {
      input_.move(ScreenPoint(560 + k % 40, 350));
      update.push_back(frame());
      drawn.push_back(paint());
      if (bench_.session().shape() != shape) ++meshes;
      shape = bench_.session().shape();
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
    }
    beside += spent_beside_ms();
    std::printf(
        "  the solver runs: %zu frames in %.1f s, %d meshes, %.0f %% of a processor beside\n",
        update.size(), (clock_ms() - begin) / 1e3, static_cast<int>(meshes),
        100 * beside / (clock_ms() - begin));
    if (update.empty()) return;
    std::printf("  to start it takes %.2f ms of the window's thread\n", start);
    report("meanwhile, update", update);
    report("meanwhile, drawn by the processor", drawn);
    bench_.apply(action::CancelSolver{});
    settle();
  }

  std::unique_ptr<HeadlessContext> context_ = make_headless_context();
  Workbench bench_;
  FrameBuffer buffer_{width, height, 4};
  InputQueue input_;
};

}  // namespace

int main(int count, char** arguments) {
  const bool open_alone = count > 1 && std::string(arguments[1]) == "--open";
  const int first = open_alone ? 2 : 1;
  for (int k = first; k < count; ++k) {
    SpaceBench bench(arguments[k]);
    if (!open_alone) bench.run();
  }
  return count > first ? 0 : 1;
}
