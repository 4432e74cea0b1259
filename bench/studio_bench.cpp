// The studio's frames on growing meshes, all panels open, while the solver runs; and the time from
// a mesh that has been read to the first picture of it. Without a display (EGL). A table for each.
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
#include "gui/render/gl_context.h"
#include "gui/studio/workbench.h"
#include "io/mesh_file.h"
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
  for (const Index node : mesh.topology->free_nodes())
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
  double wall = 0;  ///< of update, by the clock
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
    report("idle", frames(40, [] { return true; }));
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
        "%9s | longest frame: update %.1f, upload %.1f ms; longest update by the clock %.1f ms\n",
        "", worst.update, worst.upload, wall);
  }

 private:
  FrameTimes frame() {
    FrameTimes times;
    InputState input;
    input.mouse_inside = true;
    input.mouse = Vec2(700 + count_ % 40, 400);
    ++count_;
    const double begin = now();
    times.update = ms_of([&] { bench_.update(input, width, height, 1.0 / 60); });
    times.wall = 1e3 * (now() - begin);
    const auto paint = [&] {
      buffer_.bind();
      bench_.paint();
      glFinish();
    };
    const double first = ms_of(paint);
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
    const double begin = now();
    bench_.apply(action::OpenMesh{path_});
    while (!bench_.session().document()) {
      bench_.poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const double read = now();
    // The picture is there when nothing is being prepared any more, colours included.
    do {
      frame();
    } while (!bench_.settled());
    frame();
    const auto& topology = *bench_.session().document()->topology();
    std::printf(
        "%9d nodes, %d elements: read and prepared in %.2f s, first whole picture %.2f s "
        "after that\n",
        topology.node_count(), topology.element_count(), read - begin, now() - read);
  }

  static void report(const char* what, const std::vector<FrameTimes>& times) {
    const auto column = [&](auto part, double share) {
      std::vector<double> values;
      for (const FrameTimes& t : times) values.push_back(std::invoke(part, t));
      return quantile(values, share);
    };
    std::printf(
        "%9s | %5zu frames | update %6.2f (95%% %6.2f) | upload %6.2f (95%% %6.2f) | "
        "own %6.2f (95%% %6.2f) | driver %6.1f ms\n",
        what, times.size(), column(&FrameTimes::update, 0.5), column(&FrameTimes::update, 0.95),
        column(&FrameTimes::upload, 0.5), column(&FrameTimes::upload, 0.95),
        column(&FrameTimes::own, 0.5), column(&FrameTimes::own, 0.95),
        column(&FrameTimes::draw, 0.5));
    std::fflush(stdout);
  }

  std::filesystem::path path_;
  std::unique_ptr<HeadlessContext> context_ = make_headless_context();
  Workbench bench_;
  FrameBuffer buffer_{width, height, 4};
  int count_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<long> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::max(std::atol(argv[i]), 100L));
  if (sizes.empty()) sizes = {15000, 200000, 500000};
  for (const long nodes : sizes) Bench(nodes).run();
  return 0;
}
