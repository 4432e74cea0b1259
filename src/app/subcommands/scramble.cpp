#include "app/job/edit_job.h"
#include "app/options/option_flags.h"
#include "app/subcommands/subcommand.h"
#include "core/command/option_tables.h"

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
    add_option_flags(app(), option_table(command_), "Scramble");
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
