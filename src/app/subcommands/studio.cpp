#include <iostream>
#include <vector>

#include "app/options/file_flags.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#ifdef WINSLOW_HAS_GUI
#include "gui/studio.h"
#endif

namespace winslow::app {
namespace {

constexpr int largest_window = 16384;

class StudioSubcommand : public Subcommand {
 public:
  explicit StudioSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "studio", "Open the window in which meshes are moved and repaired by hand")) {
    app().add_option("IN", input_, "Mesh to open")->type_name("");
    app()
        .add_option("--screenshot", screenshot_,
                    "Draw the window once, without a display, as a PNG picture")
        ->type_name("OUT.png");
    app()
        .add_option("--size", size_,
                    "Width and height of the window [as last time, 1440 900 at first]")
        ->type_name("W H")
        ->expected(2);
    add_quiet_flag(app(), quiet_);
  }

  ExitCode run() override {
    check_output(screenshot_);
    for (const int pixels : size_) {
      if (pixels < 320 || pixels > largest_window) {
        throw UsageError("--size: found " + std::to_string(pixels) + ", expected 320 to " +
                         std::to_string(largest_window));
      }
    }
    open();
    if (!screenshot_.empty() && !quiet_) std::cout << "Wrote " << screenshot_ << '\n';
    return ExitCode::done;
  }

 private:
#ifdef WINSLOW_HAS_GUI
  void open() const {
    gui::StudioOptions options;
    if (!input_.empty()) options.mesh = input_;
    if (!size_.empty()) {
      options.width = size_[0];
      options.height = size_[1];
    }
    if (screenshot_.empty()) {
      gui::run_studio(options);
    } else {
      gui::screenshot_studio(options, screenshot_);
    }
  }
#else
  void open() const {
    throw Error("this winslow was built without graphics (WINSLOW_BUILD_GUI=OFF): no studio");
  }
#endif

  std::string input_, screenshot_;
  std::vector<int> size_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_studio_subcommand(CLI::App& program) {
  return std::make_unique<StudioSubcommand>(program);
}

}  // namespace winslow::app
