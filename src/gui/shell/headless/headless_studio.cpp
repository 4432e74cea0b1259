#include "gui/shell/headless/headless_studio.h"

#include <chrono>
#include <thread>

#include "core/error.h"

namespace winslow::gui {

namespace {

constexpr double frame_seconds = 1.0 / 60;

void rest() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

}  // namespace

HeadlessStudio::HeadlessStudio(int width, int height)
    : context_(make_headless_context()),
      bench_(std::make_unique<Workbench>()),
      width_(width),
      height_(height) {
  frames();
}

void HeadlessStudio::resize(int width, int height) {
  width_ = width;
  height_ = height;
  frames();
}

void HeadlessStudio::frame() { bench_->update(input_, width_, height_, frame_seconds); }

void HeadlessStudio::frames(int more) {
  while (!input_.empty()) frame();
  for (int k = 0; k < more; ++k) frame();
}

void HeadlessStudio::throw_if_wrong() const {
  const Prompt* prompt = bench_->session().messages().prompt();
  if (prompt && prompt->kind == Prompt::Kind::error)
    throw Error(prompt->title + ": " + prompt->text);
}

void HeadlessStudio::settle() {
  const auto busy = [this] {
    return bench_->session().files().loading() || !bench_->settled() ||
           (bench_->session().job().active() && !bench_->session().job().paused());
  };
  frames();
  while (busy()) {
    rest();
    frames(1);
    throw_if_wrong();
  }
  // Windows of the interface take a frame or two to find their sizes.
  frames(3);
  throw_if_wrong();
}

void HeadlessStudio::open(const std::filesystem::path& mesh, int zone) {
  bench_->apply(action::OpenMesh{mesh, true, zone});
  try {
    settle();
  } catch (const Error&) {
    throw InputError(bench_->session().messages().prompt()->text);
  }
}

void HeadlessStudio::replay(const std::vector<Command>& commands,
                            const std::function<void()>& seen) {
  last_seen_ = Coordinates();
  for (const Command& command : commands) {
    bench_->apply(action::RunCommand{command, static_cast<bool>(seen)});
    throw_if_wrong();
    if (seen) run_stepwise(seen);
    settle();
  }
}

void HeadlessStudio::run_stepwise(const std::function<void()>& seen) {
  const auto look = [&] {
    frames(1);
    throw_if_wrong();
    if (last_seen_ == bench_->session().coordinates()) return;
    last_seen_ = bench_->session().coordinates();
    seen();
  };
  const JobRunner& job = bench_->session().job();
  std::uint64_t left = 0;
  while (job.active()) {
    look();
    const auto snapshot = job.snapshot();
    // A step that was asked for takes a while to be seen: each pause is left once.
    if (snapshot && snapshot->state == JobState::paused && snapshot->serial != left) {
      left = snapshot->serial;
      bench_->apply(action::StepSolver{1});
    } else {
      rest();
    }
  }
  look();
}

}  // namespace winslow::gui
