#include "app/job/edit_job.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#include "io/recipe/recipe.h"

namespace winslow::app {
namespace {

class ReplaySubcommand : public Subcommand {
 public:
  explicit ReplaySubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand("replay", "Apply the commands of a recipe, in order")) {
    app().add_option("RECIPE", recipe_, "Recipe to run (JSON)")->required()->type_name("");
    app()
        .add_option("--input", files_.input, "Mesh to start from instead of the recipe's")
        ->type_name("IN");
    threads_flag_ = app()
                        .add_option("--threads", threads_, "Threads; 0 for all cores")
                        ->check(CLI::Range(0, 4096))
                        ->option_text("N");
    add_job_flags(app(), files_);
  }

  ExitCode run() override {
    io::Recipe recipe = io::read_recipe(recipe_);
    const auto folder = std::filesystem::path(recipe_).parent_path();
    if (files_.input.empty() && !recipe.input.empty()) {
      files_.input = (folder / recipe.input).string();
    }
    if (files_.output.empty() && !recipe.output.empty()) {
      files_.output = (folder / recipe.output).string();
    }
    if (files_.zone == 0) files_.zone = recipe.zone;
    if (files_.input.empty()) {
      throw UsageError(recipe_ + " names no mesh to start from: give one with --input IN");
    }
    if (threads_flag_->count() > 0) {
      for (Command& command : recipe.commands) {
        if (SmoothOptions* options = smooth_options(command)) options->threads = threads_;
      }
    }
    return run_edit_job({"replay", files_, std::move(recipe.commands)});
  }

 private:
  std::string recipe_;
  JobFiles files_;
  int threads_ = 0;
  CLI::Option* threads_flag_ = nullptr;
};

}  // namespace

std::unique_ptr<Subcommand> make_replay_subcommand(CLI::App& program) {
  return std::make_unique<ReplaySubcommand>(program);
}

}  // namespace winslow::app
