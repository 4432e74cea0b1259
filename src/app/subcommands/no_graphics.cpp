#include "app/subcommands/subcommand.h"
#include "core/error.h"

// Replaces render.cpp, render_volume.cpp and studio.cpp in a build without winslow::gui.
namespace winslow::app {
namespace {

/// A command that this build does not support. It is hidden from the help, the manual page and the
/// completions, and only tells its users what is missing.
class MissingSubcommand : public Subcommand {
 public:
  MissingSubcommand(CLI::App& program, const std::string& name)
      : Subcommand(program.add_subcommand(name, "Not in this program, which has no graphics")) {
    app().group("");
    app().allow_extras();
  }

  ExitCode run() override {
    throw Error("\"winslow " + app().get_name() +
                "\" draws, and this winslow was built without graphics: configure another one with "
                "-DWINSLOW_BUILD_GUI=ON, on a machine with OpenGL, GLFW and Dear ImGui");
  }
};

}  // namespace

std::unique_ptr<Subcommand> make_render_subcommand(CLI::App& program) {
  return std::make_unique<MissingSubcommand>(program, "render");
}

std::unique_ptr<Subcommand> make_studio_subcommand(CLI::App& program) {
  return std::make_unique<MissingSubcommand>(program, "studio");
}

}  // namespace winslow::app
