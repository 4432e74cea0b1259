#pragma once

#include <string>

#include "app/job/edit_job.h"
#include "app/options/option_flags.h"
#include "app/options/smooth_flags.h"
#include "app/subcommands/subcommand.h"
#include "core/command/option_tables.h"

namespace winslow::app {

/// The subcommand of a command that its table of options describes.
template <class EditCommand>
class TableSubcommand : public Subcommand {
 public:
  explicit TableSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(std::string(EditCommand::name),
                                          std::string(EditCommand::summary))) {
    add_input(app(), files_.input);
    if constexpr (requires { command_.markers; }) add_marker_flag(app(), command_.markers);
    add_option_flags(app(), option_table(command_), "Options");
    if constexpr (requires { command_.smooth; }) add_smooth_flags(app(), command_.smooth);
    add_job_flags(app(), files_);
    add_recipe_flag(app(), files_);
  }

  ExitCode run() override {
    return run_edit_job({std::string(EditCommand::name), files_, {command_}});
  }

 private:
  JobFiles files_;
  EditCommand command_;
};

}  // namespace winslow::app
