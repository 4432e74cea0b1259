#include "app/job/edit_job.h"
#include "app/options/layer_flags.h"
#include "app/options/option_flags.h"
#include "app/subcommands/subcommand.h"
#include "core/command/option_tables.h"
#include "core/error.h"
#include "core/motion/motion.h"
#include "io/tables/displacement_file.h"

namespace winslow::app {
namespace {

class DeformSubcommand : public Subcommand {
 public:
  explicit DeformSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(std::string(DeformCommand::name),
                                          std::string(DeformCommand::summary))) {
    add_input(app(), files_.input);
    add_marker_flag(app(), command_.markers);
    add_shape_flags();
    add_option_flags(app(), option_table(command_), "Motion");
    add_direct_flag(app(), command_.how);
    add_min_quality_flag(app(), command_.how.floor);
    add_hold_layers_flag(app(), held_);
    add_smooth_flags(app(), command_.smooth);
    add_job_flags(app(), files_);
    add_recipe_flag(app(), files_);
  }

  ExitCode run() override {
    const bool sine = sine_flag_->count() > 0;
    if (sine == (table_flag_->count() > 0)) {
      throw UsageError("give either --sine AMPLITUDE WAVES or --displacements FILE");
    }
    if (sine) {
      command_.shape = sine_;
    } else {
      command_.shape = io::read_displacements(table_);
    }
    return run_edit_job({"deform", files_, holding_layers(held_, command_.smooth, command_)});
  }

 private:
  void add_shape_flags() {
    sine_flag_ = app()
                     .add_option_function<std::array<double, 2>>(
                         "--sine",
                         [this](const std::array<double, 2>& v) {
                           sine_.amplitude = v[0];
                           sine_.waves = v[1];
                         },
                         "Add a sine wave along the body: amplitude, number of periods")
                     ->type_name("AMPLITUDE WAVES")
                     ->group("Shape");
    table_flag_ = app()
                      .add_option("--displacements", table_,
                                  "CSV of node,dx,dy (0-based node) or x,y,dx,dy; "
                                  "of volume meshes node,dx,dy,dz or x,y,z,dx,dy,dz, "
                                  "the names in the first line")
                      ->type_name("FILE.csv")
                      ->group("Shape");
    const OptionTable options = option_table(sine_);
    add_option_flags(app(), options, "Shape");
    for (const Option& option : options) {
      if (option.on_command_line == OnCommandLine::yes)
        app().get_option(flag_of(option))->needs(sine_flag_);
    }
  }

  JobFiles files_;
  std::vector<std::string> held_;
  DeformCommand command_;
  SineDeformation sine_;
  std::string table_;
  CLI::Option* sine_flag_ = nullptr;
  CLI::Option* table_flag_ = nullptr;
};

}  // namespace

std::unique_ptr<Subcommand> make_deform_subcommand(CLI::App& program) {
  return std::make_unique<DeformSubcommand>(program);
}

}  // namespace winslow::app
