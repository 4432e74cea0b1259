#include "app/job/edit_job.h"
#include "app/options/smooth_flags.h"
#include "app/subcommands/subcommand.h"

namespace winslow::app {
namespace {

class SmoothSubcommand : public Subcommand {
 public:
  explicit SmoothSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand("smooth", "Smooth the interior, the boundary held")) {
    add_input(app(), files_.input);
    add_smooth_flags(app(), command_.smooth);
    add_job_flags(app(), files_);
    add_recipe_flag(app(), files_);
  }

  ExitCode run() override { return run_edit_job({"smooth", files_, {command_}}); }

 private:
  JobFiles files_;
  SmoothCommand command_;
};

}  // namespace

std::unique_ptr<Subcommand> make_smooth_subcommand(CLI::App& program) {
  return std::make_unique<SmoothSubcommand>(program);
}

}  // namespace winslow::app
