#include <iostream>

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "app/output/terminal.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#include "gui/picture/capture/film.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/shell/headless/headless_studio.h"
#include "gui/shell/studio.h"

namespace winslow::app {
namespace {

constexpr int largest_window = 16384;

class StudioSubcommand : public Subcommand {
 public:
  explicit StudioSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "studio", "Open the window in which meshes are moved and repaired by hand")) {
    app().add_option("IN", input_, "Mesh to open")->type_name("");
    add_reading_flags(app(), reading_, "the first");
    FlagGroup(app()).value("--size", size_, "W H", "Width and height of the window [1440 900]");
    add_quiet_flag(app(), quiet_);
    add_headless_flags();
  }

  ExitCode run() override {
    check_flags();
    return open();
  }

 private:
  void add_headless_flags() {
    FlagGroup group(app(), "Without a display");
    group.on("--headless", headless_, "Open no window; needs --screenshot, --frames or --script");
    group.value("--screenshot", screenshot_, "OUT.png",
                "Draw the window at the end: .png, or the mesh alone as .svg or .pdf");
    group.value("--replay", recipe_, "FILE.json", "Carry out a recipe first");
    group.value("--frames", frames_, "DIR",
                "Draw every mesh on the recipe's way: PNG files into a folder, or a film .mp4 or "
                ".gif (by ffmpeg)");
    group.value("--rate", rate_, "N", "Frames a second of a film [20]")->check(CLI::Range(1, 60));
    group
        .value_as("--panels", panels_, "all|none [all]",
                  "What pictures show: all of the window, or the mesh alone")
        ->check(one_of({"all", "none"}));
    group.value("--scale", scale_, "K", "Pictures at this many times the window's size [1]")
        ->check(CLI::Range(0.1, 8.0));
    group.on("--transparent", transparent_, "No background; with --panels none");
    group.value("--script", script_, "FILE",
                "Play a script of mouse and keys (see docs/studio.md)");
  }

  bool headless() const {
    return headless_ || !screenshot_.empty() || !frames_.empty() || !script_.empty();
  }

  void check_flags() const {
    check_output(screenshot_);
    if (!screenshot_.empty()) gui::check_picture_name(screenshot_);
    for (const int pixels : size_) {
      if (pixels < 320 || pixels > largest_window) {
        throw UsageError("--size: found " + std::to_string(pixels) + ", expected 320 to " +
                         std::to_string(largest_window));
      }
    }
    if (headless_ && screenshot_.empty() && frames_.empty() && script_.empty()) {
      throw UsageError(
          "--headless draws no window: say what to draw instead with --screenshot OUT.png, "
          "--frames DIR or --script FILE");
    }
    if (!recipe_.empty() && !headless()) {
      throw UsageError(
          "--replay needs --headless and --screenshot OUT.png or --frames DIR; "
          "\"winslow replay\" writes the mesh");
    }
    if (!frames_.empty() && recipe_.empty()) {
      throw UsageError("--frames needs the recipe whose meshes are drawn: --replay FILE.json");
    }
    if (transparent_ && panels_ != "none") {
      throw UsageError("--transparent is for the mesh alone: add --panels none");
    }
    check_inputs_kept({screenshot_, frames_}, {input_, recipe_, script_});
  }

  ExitCode open() const {
    if (headless()) return run_headless();
    gui::StudioOptions options;
    if (!input_.empty()) options.mesh = input_;
    options.reading = reading_;
    options.width = size_[0];
    options.height = size_[1];
    gui::run_studio(options);
    return ExitCode::done;
  }

  ExitCode run_headless() const {
    gui::HeadlessOptions options;
    if (!input_.empty()) options.mesh = input_;
    options.reading = reading_;
    options.recipe = recipe_;
    options.script = script_;
    options.picture = screenshot_;
    options.frames = frames_;
    options.width = size_[0];
    options.height = size_[1];
    options.recording.rate = rate_;
    options.recording.picture.panels = panels_ == "all";
    options.recording.picture.scale = scale_;
    options.recording.picture.transparent = transparent_;
    options.check = [](const std::vector<Command>& commands, const Topology& topology,
                       const std::string& file) {
      for (const Command& command : commands) {
        if (const SmoothOptions* smooth = smooth_options(command)) validate(*smooth);
      }
      check_markers(commands, topology, file);
    };
    if (!quiet_) {
      options.say = [](const std::string& line) { std::cout << printable(line) << std::endl; };
      options.warn = [](const std::string& text) { print_warnings({text}); };
    }
    if (gui::film_format(frames_)) check_output(frames_);
    const gui::HeadlessResult result = gui::run_headless(options);
    return recipe_.empty() ? ExitCode::done : judge(result);
  }

  static ExitCode judge(const gui::HeadlessResult& result) {
    if (result.inverted > 0) {
      std::cerr << "winslow: the result has " << result.inverted << " inverted element"
                << (result.inverted == 1 ? "" : "s") << '\n';
      return ExitCode::inverted;
    }
    if (result.fraction_reached < 1) {
      std::cerr << "winslow: a motion could be followed to " << 100 * result.fraction_reached
                << " % only\n";
      return ExitCode::inverted;
    }
    if (!result.converged) {
      std::cerr << "winslow: not converged; the mesh is valid\n";
      return ExitCode::not_converged;
    }
    return ExitCode::done;
  }

  std::string input_, screenshot_, recipe_, frames_, script_;
  std::string panels_ = "all";
  std::array<int, 2> size_{1440, 900};
  int rate_ = 20;
  io::ReadOptions reading_;
  double scale_ = 1;
  bool headless_ = false, transparent_ = false, quiet_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_studio_subcommand(CLI::App& program) {
  return std::make_unique<StudioSubcommand>(program);
}

}  // namespace winslow::app
