#include "app/subcommands/subcommand.h"

#include "app/job/edit_job.h"
#include "app/options/option_flags.h"
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

namespace {

// The subcommand of each kind of command; null: it has none.

template <class EditCommand>
requires(!EditCommand::beyond_table) std::unique_ptr<Subcommand> make_for(const EditCommand&,
                                                                          CLI::App& program) {
  return std::make_unique<TableSubcommand<EditCommand>>(program);
}

/// It tells a motion that is not given from one by 0, and may hold layers.
std::unique_ptr<Subcommand> make_for(const MoveCommand&, CLI::App& program) {
  return make_move_subcommand(program);
}

std::unique_ptr<Subcommand> make_for(const DeformCommand&, CLI::App& program) {
  return make_deform_subcommand(program);
}

std::unique_ptr<Subcommand> make_for(const LayersCommand&, CLI::App& program) {
  return make_layers_subcommand(program);
}

/// Virtual control volumes are edited in the studio and in recipes.
std::unique_ptr<Subcommand> make_for(const EditVcvCommand&, CLI::App&) { return nullptr; }

}  // namespace

SubcommandList make_subcommands(CLI::App& program) {
  SubcommandList list;
  for (const Command& command : all_commands()) {
    auto subcommand = std::visit([&](const auto& of) { return make_for(of, program); }, command);
    if (subcommand) list.push_back(std::move(subcommand));
  }
  for (auto* make : {make_quality_subcommand, make_render_subcommand, make_convert_subcommand,
                     make_replay_subcommand, make_studio_subcommand, make_reference_subcommand}) {
    list.push_back(make(program));
  }
  return list;
}

}  // namespace winslow::app
