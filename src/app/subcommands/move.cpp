#include "app/job/edit_job.h"
#include "app/options/layer_flags.h"
#include "app/options/option_flags.h"
#include "app/subcommands/subcommand.h"
#include "core/command/option_tables.h"
#include "core/error.h"

namespace winslow::app {
namespace {

class MoveSubcommand : public Subcommand {
 public:
  explicit MoveSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(std::string(MoveCommand::name),
                                          std::string(MoveCommand::summary))) {
    add_input(app(), files_.input);
    add_marker_flag(app(), command_.markers);
    add_option_flags(app(), option_table(command_), "Motion");
    add_direct_flag(app(), command_.how);
    add_min_quality_flag(app(), command_.how.floor);
    add_hold_layers_flag(app(), held_);
    add_smooth_flags(app(), command_.smooth);
    add_job_flags(app(), files_);
    add_recipe_flag(app(), files_);
  }

  ExitCode run() override {
    if (app().count("--rotate") + app().count("--translate") == 0) {
      throw UsageError("nothing to do: give --rotate DEG, --translate DX DY, or both");
    }
    return run_edit_job({"move", files_, holding_layers(held_, command_.smooth, command_)});
  }

 private:
  JobFiles files_;
  std::vector<std::string> held_;
  MoveCommand command_;
};

}  // namespace

std::unique_ptr<Subcommand> make_move_subcommand(CLI::App& program) {
  return std::make_unique<MoveSubcommand>(program);
}

}  // namespace winslow::app
