#include "app/subcommands/subcommand.h"

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "core/command/option_tables.h"
#include "core/error.h"
#include "core/motion/motion.h"
#include "io/recipe/recipe.h"
#include "io/tables/table_files.h"

namespace winslow::app {
namespace {

class MoveSubcommand : public Subcommand {
 public:
  explicit MoveSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(std::string(MoveCommand::name),
                                          std::string(MoveCommand::summary))) {
    add_input(app(), files_.input);
    add_marker_flag(app(), command_.bodies.front().markers);
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
