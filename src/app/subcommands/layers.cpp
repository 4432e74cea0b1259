#include "app/job/edit_job.h"
#include "app/options/layer_flags.h"
#include "app/options/option_flags.h"
#include "app/subcommands/subcommand.h"
#include "core/command/option_tables.h"

namespace winslow::app {
namespace {

class LayersSubcommand : public Subcommand {
 public:
  explicit LayersSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(std::string(LayersCommand::name),
                                          std::string(LayersCommand::summary))) {
    add_input(app(), files_.input);
    flags_.declare(app());
    add_option_flags(app(), option_table(command_), "Layers");
    app()
        .add_flag_callback(
            "--respace", [this] { command_.task = LayerTask::respace; },
            "Give the layers that the mesh has at these walls other heights; --count is the limit "
            "of how many of them are changed")
        ->excludes(app().get_option("--no-control"))
        ->group("Layers");
    add_smooth_flags(app(), command_.smooth);
    add_job_flags(app(), files_);
    add_recipe_flag(app(), files_);
  }

  ExitCode run() override {
    flags_.finish(command_.layers);
    return run_edit_job({"layers", files_, {command_}});
  }

 private:
  JobFiles files_;
  LayersCommand command_;
  LayerFlags flags_;
};

}  // namespace

std::unique_ptr<Subcommand> make_layers_subcommand(CLI::App& program) {
  return std::make_unique<LayersSubcommand>(program);
}

}  // namespace winslow::app
