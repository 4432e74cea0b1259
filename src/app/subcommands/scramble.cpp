#include "app/job/edit_job.h"
#include "app/subcommands/subcommand.h"

namespace winslow::app {
namespace {

class ScrambleSubcommand : public Subcommand {
 public:
  explicit ScrambleSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "scramble",
            "Put every interior node at a random place of the mesh's bounding box: a test of "
            "smoothing (needs --allow-inverted to be written)")) {
    add_input(app(), files_.input);
    app()
        .add_option("--seed", command_.seed, "Seed of the random numbers")
        ->check([](const std::string& text) {  // the conversion would wrap a negative number
          return text.starts_with("-") ? "found " + text + ", expected 0 or more" : std::string();
        })
        ->option_text("N [1]");
    add_job_flags(app(), files_);
    add_recipe_flag(app(), files_);
  }

  ExitCode run() override { return run_edit_job({"scramble", files_, {command_}}); }

 private:
  JobFiles files_;
  ScrambleCommand command_;
};

}  // namespace

std::unique_ptr<Subcommand> make_scramble_subcommand(CLI::App& program) {
  return std::make_unique<ScrambleSubcommand>(program);
}

}  // namespace winslow::app
