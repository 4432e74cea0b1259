#include <array>

#include "app/job/edit_job.h"
#include "app/options/layer_flags.h"
#include "app/options/smooth_flags.h"
#include "app/options/suggestion.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#include "io/displacement_file.h"

namespace winslow::app {
namespace {

Fade parse_fade(const std::string& text) {
  if (text == "start") return Fade::start;
  if (text == "end") return Fade::end;
  return text == "both" ? Fade::both : Fade::none;
}

class DeformSubcommand : public Subcommand {
 public:
  explicit DeformSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand("deform", "Change the shape of bodies, then smooth")) {
    add_input(app(), files_.input);
    add_marker_flag(app(), command_.markers);
    add_shape_flags();
    add_motion_flags(app(), command_.how);
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
    table_flag_ =
        app()
            .add_option("--displacements", table_, "CSV of node,dx,dy (0-based node) or x,y,dx,dy")
            ->type_name("FILE.csv")
            ->group("Shape");
    add_vector_flag(app(), "--direction", sine_.direction, "Direction of the displacement [0 1]")
        ->type_name("DX DY")
        ->needs(sine_flag_)
        ->group("Shape");
    app()
        .add_option_function<std::string>(
            "--fade", [this](const std::string& text) { sine_.fade = parse_fade(text); },
            "Ends of the body at which the wave fades to zero [none]")
        ->check(one_of({"none", "start", "end", "both"}))
        ->option_text("none|start|end|both")
        ->needs(sine_flag_)
        ->group("Shape");
    app()
        .add_option("--fade-length", sine_.fade_length,
                    "Share of the body's length over which it fades, (0, 0.5]")
        ->option_text("SHARE [0.2]")
        ->needs(sine_flag_)
        ->group("Shape");
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
