#include "gui/shell/headless/headless_studio.h"

#include "core/error.h"
#include "core/quality/quality.h"
#include "gui/picture/capture/capture.h"
#include "gui/picture/capture/recorder.h"
#include "gui/picture/figure/vector_figure.h"
#include "io/recipe/recipe.h"
#include "io/tables/file_defaults.h"

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
  // ImGui windows need one or two frames to determine their sizes.
  frames(3);
  throw_if_wrong();
}

void HeadlessStudio::open(const std::filesystem::path& mesh, const io::ReadOptions& reading) {
  bench_->apply(action::OpenMesh{mesh, true, reading});
  try {
    settle();
  } catch (const Error&) {
    throw InputError(bench_->session().messages().prompt()->text);
  }
}

std::vector<Command> HeadlessStudio::expanded(const std::vector<Command>& commands) const {
  const Document* document = bench_->session().document();
  if (!document) return commands;
  return io::with_names_expanded(commands, document->source().details.get(), *document->topology());
}

void HeadlessStudio::replay(const std::vector<Command>& commands,
                            const std::function<void()>& seen) {
  last_seen_ = Coordinates();
  for (const Command& command : expanded(commands)) {
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
    // A requested step takes effect with a delay: step only once per pause.
    if (snapshot && snapshot->state == JobState::paused && snapshot->serial != left) {
      left = snapshot->serial;
      bench_->apply(action::StepSolver{1});
    } else {
      rest();
    }
  }
  look();
}

namespace {

namespace fs = std::filesystem;

/// Draws the frames of a recording and makes its film.
class FrameTaker {
 public:
  FrameTaker(HeadlessStudio& studio, const HeadlessOptions& options)
      : studio_(studio), options_(options) {
    recorder_.start(options.frames, options.recording);
  }

  /// Records the mesh on screen and the meshes before it.
  void record() {
    PicturePainter& painter = studio_.bench().pictures();
    PictureSpec spec = options_.recording.picture;
    if (!spec.size) {
      const ScreenVector extent = painter.picture_extent(spec);
      spec.size = picture_size(spec, extent.x(), extent.y());
    }
    for (const Coordinates& x : meshes_.collect(studio_.bench().session()))
      recorder_.add(painter.picture_of(x, spec));  // waits for the disk if necessary
  }

  /// Finishes the film and returns a message for the user.
  std::string finish() {
    recorder_.stop();
    for (;;) {
      if (const auto outcome = recorder_.poll()) {
        if (outcome->kind != Recorder::Outcome::Kind::done) throw OutputError(outcome->text);
        return outcome->text;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

 private:
  HeadlessStudio& studio_;
  const HeadlessOptions& options_;
  Recorder recorder_;
  FilmMeshes meshes_;
};

io::Recipe read_recipe(const HeadlessOptions& options) {
  if (options.recipe.empty()) return {};
  io::Recipe recipe = io::read_recipe(options.recipe);
  if (!recipe.input.empty()) recipe.input = (options.recipe.parent_path() / recipe.input).string();
  return recipe;
}

void judge(const Document& document, HeadlessResult& result) {
  const Mesh& mesh = document.state().mesh;
  result.inverted = check_validity(*mesh.topology, mesh.coordinates).inverted;
  for (std::size_t k = 1; k <= document.history().position(); ++k) {
    const SmoothResult& smooth = document.history().result(k);
    result.converged = result.converged && smooth.converged;
    result.fraction_reached = std::min(result.fraction_reached, smooth.fraction_reached);
  }
}

void write_picture(HeadlessStudio& studio, const HeadlessOptions& options) {
  const PictureSpec& spec = options.recording.picture;
  if (is_vector_format(options.picture))
    write_figure(options.picture, studio.bench().pictures().figure(spec.legend));
  else if (spec == PictureSpec{})
    write_png(options.picture, studio.bench().pictures().picture());
  else
    write_png(options.picture, studio.bench().pictures().picture(spec));
}

}  // namespace

HeadlessResult run_headless(const HeadlessOptions& options) {
  const io::Recipe recipe = read_recipe(options);
  const Script script = options.script.empty() ? Script{} : read_script(options.script);
  const fs::path mesh = options.mesh.value_or(fs::path(recipe.input));
  if (!options.recipe.empty() && mesh.empty())
    throw UsageError(options.recipe.string() + " names no mesh to start from: give one");

  HeadlessResult result;
  HeadlessStudio studio(options.width, options.height);
  io::ReadOptions reading = options.reading;
  if (reading.zone == 0) reading.zone = recipe.zone;
  if (reading.regions.empty()) reading.regions = recipe.regions;
  if (!mesh.empty()) studio.open(mesh, reading);
  if (const Document* document = studio.bench().session().document()) {
    for (const std::string& text : document->source().warnings) options.warn(text);
    if (reading.zone == 0)
      for (const std::string& text : io::zones_left(document->source().details.get(), mesh))
        options.warn(text);
    // Reported here; dismiss the prompt, which would be visible in the picture.
    studio.bench().apply(action::DismissPrompt{});
    if (options.check)
      options.check(studio.expanded(recipe.commands), *document->topology(), mesh.string());
  }
  if (options.frames.empty()) {
    studio.replay(recipe.commands);
  } else {
    FrameTaker taker(studio, options);
    studio.replay(recipe.commands, [&taker] { taker.record(); });
    options.say(taker.finish());
  }
  play_script(script, studio, options.folder, options.say);
  if (!options.picture.empty()) {
    studio.settle();
    write_picture(studio, options);
    options.say("Wrote " + options.picture.string());
  }
  if (const Document* document = studio.bench().session().document()) judge(*document, result);
  return result;
}

}  // namespace winslow::gui
