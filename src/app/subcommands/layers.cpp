#include <optional>

#include "app/job/edit_job.h"
#include "app/options/layer_flags.h"
#include "app/options/smooth_flags.h"
#include "app/subcommands/subcommand.h"

namespace winslow::app {
namespace {

class LayersSubcommand : public Subcommand {
 public:
  explicit LayersSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "layers", "Insert viscous layers at walls: quadrilaterals of wanted heights")) {
    add_input(app(), files_.input);
    flags_.declare(app());
    CLI::Option* respace =
        app()
            .add_flag_callback(
                "--respace", [this] { command_.task = LayerTask::respace; },
                "Give the layers that the mesh has at these walls other heights; --count is the "
                "most of them that are taken in hand")
            ->group("Layers");
    app()
        .add_flag_callback(
            "--no-control", [this] { command_.control = false; },
            "Smooth the new connectivity as it is, without holding heights")
        ->excludes(respace)
        ->group("Layers");
    app()
        .add_option("--height-tolerance", command_.tolerance,
                    "Relative error of a height above which the VCVs are corrected")
        ->option_text("SHARE [0.002]")
        ->group("Layers");
    add_smooth_flags(app(), command_.smooth);
    add_job_flags(app(), files_);
    add_recipe_flag(app(), files_);
  }

  ExitCode run() override {
    command_.layers = flags_.options();
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
