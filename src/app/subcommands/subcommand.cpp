#include "app/subcommands/subcommand.h"

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "core/command/option_tables.h"
#include "core/error.h"
#include "core/motion/node_table.h"
#include "io/recipe/recipe.h"
#include "io/tables/table_files.h"

namespace winslow::app {
namespace {

/// The subcommand of a command that changes a mesh. It has a flag for each option of the command's
/// table, and the flags common to all such commands.
template <class EditCommand>
class EditSubcommand : public Subcommand {
 public:
  ExitCode run() override {
    const std::string name(EditCommand::name);
    if constexpr (requires { command_.how; })
      return run_edit_job({name, files_, holding_layers(held_, command_.smooth, command_)});
    else
      return run_edit_job({name, files_, {command_}});
  }

 protected:
  explicit EditSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(std::string(EditCommand::name),
                                          std::string(EditCommand::summary))) {
    add_input(app(), files_.input);
  }

  void add_table_flags(const char* heading) {
    add_option_flags(app(), option_table(command_), heading);
    if constexpr (requires { command_.how; }) {
      add_direct_flag(app(), command_.how);
      add_min_quality_flag(app(), command_.how.floor);
      add_hold_layers_flag(app(), held_);
      add_reference_mesh_flag(app(), files_);
    }
  }

  /// Declares the common flags, which come last.
  void add_common_flags() {
    if constexpr (requires { command_.smooth; }) add_smooth_flags(app(), command_.smooth);
    add_job_flags(app(), files_);
    add_recipe_flag(app(), files_);
  }

  JobFiles& files() { return files_; }

  EditCommand command_;

 private:
  JobFiles files_;
  std::vector<std::string> held_;
};

/// The subcommand of a command that its table describes completely.
template <class EditCommand>
class TableSubcommand : public EditSubcommand<EditCommand> {
 public:
  explicit TableSubcommand(CLI::App& program) : EditSubcommand<EditCommand>(program) {
    if constexpr (requires { this->command_.markers; })
      add_marker_flag(this->app(), this->command_.markers);
    this->add_table_flags("Options");
    this->add_common_flags();
  }
};

/// One body by --marker and the options of its motion, or several by --body. Distinguishes a
/// missing motion from a motion by 0.
class MoveSubcommand : public EditSubcommand<MoveCommand> {
 public:
  explicit MoveSubcommand(CLI::App& program) : EditSubcommand(program) {
    add_marker_flag(app(), command_.bodies.front().markers)->required(false);
    add_table_flags("Motion");
    add_body_flag(app(), bodies_);
    add_common_flags();
  }

  ExitCode run() override {
    if (!bodies_.empty()) {
      refuse_single_body_flags(app());
      command_.bodies = bodies_;
      return EditSubcommand::run();
    }
    if (command_.bodies.front().markers.empty())
      throw UsageError(
          "nothing to move: name it by --marker NAME, or bodies with a motion each by "
          "--body NAME rotate=DEG");
    if (app().count("--rotate") + app().count("--translate") == 0) {
      throw UsageError("nothing to do: give --rotate DEG, --translate DX DY, or both");
    }
    return EditSubcommand::run();
  }

 private:
  std::vector<MovingBody> bodies_;
};

class DeformSubcommand : public EditSubcommand<DeformCommand> {
 public:
  explicit DeformSubcommand(CLI::App& program) : EditSubcommand(program) {
    add_marker_flag(app(), command_.markers)
        ->required(false)
        ->description(
            "Marker that moves; several move together. With a file of single nodes: whose "
            "nodes, besides those inside the mesh, may be in it; not given: all");
    add_shape_flags();
    add_table_flags("Motion");
    add_common_flags();
  }

  ExitCode run() override {
    const bool sine = sine_flag_->count() > 0, ways = ways_flag_->count() > 0;
    if (sine + ways + (positions_flag_->count() > 0) != 1) {
      throw UsageError(
          "give either --sine AMPLITUDE WAVES, --displacements FILE or --positions FILE");
    }
    if (!sine) files().also_read = {table_};
    if (sine) {
      if (command_.markers.empty())
        throw UsageError("--sine changes the shape of a body: give its marker with --marker NAME");
      command_.shape = sine_;
    } else if (ways) {
      command_.shape = io::read_displacements(table_);
    } else {
      command_.shape = io::read_positions(table_);
    }
    return EditSubcommand::run();
  }

 private:
  void add_shape_flags() {
    FlagGroup group(app(), "Shape");
    sine_flag_ = add_sine_flags(app(), sine_);
    ways_flag_ = group.value("--displacements", table_, "FILE.csv",
                             "How far single nodes move, on the boundary or inside: CSV of "
                             "node,dx,dy (0-based node) or x,y,dx,dy; "
                             "of volume meshes node,dx,dy,dz or x,y,z,dx,dy,dz, "
                             "the names in the first line");
    positions_flag_ = group.value("--positions", table_, "FILE.csv",
                                  "Where single nodes are afterwards: CSV of node,x,y (0-based "
                                  "node), of volume meshes node,x,y,z");
  }

  SineDeformation sine_;
  std::string table_;
  CLI::Option* sine_flag_ = nullptr;
  CLI::Option* ways_flag_ = nullptr;
  CLI::Option* positions_flag_ = nullptr;
};

class LayersSubcommand : public EditSubcommand<LayersCommand> {
 public:
  explicit LayersSubcommand(CLI::App& program) : EditSubcommand(program) {
    flags_.declare(app());
    add_table_flags("Layers");
    app()
        .add_flag_callback(
            "--respace", [this] { command_.task = LayerTask::respace; },
            "Give the layers that the mesh has at these walls other heights; --count is the limit "
            "of how many of them are changed")
        ->excludes(app().get_option("--no-control"))
        ->group("Layers");
    add_common_flags();
  }

  ExitCode run() override {
    flags_.finish(command_.layers);
    return EditSubcommand::run();
  }

 private:
  LayerFlags flags_;
};

class ReplaySubcommand : public Subcommand {
 public:
  explicit ReplaySubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand("replay", "Apply the commands of a recipe, in order")) {
    app().add_option("RECIPE", recipe_, "Recipe to run (JSON)")->required()->type_name("");
    FlagGroup group(app());
    group.value("--input", files_.input, "IN", "Mesh to start from instead of the recipe's");
    threads_flag_ =
        group.value_as("--threads", threads_, "N", "Threads; 0: all cores, or one under MPI")
            ->check(CLI::Range(0, 4096));
    add_reference_mesh_flag(app(), files_);
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
    if (files_.reading.zone == 0) files_.reading.zone = recipe.zone;
    if (files_.reading.regions.empty()) files_.reading.regions = recipe.regions;
    files_.also_read = std::move(recipe.tables);
    files_.also_read.push_back(recipe_);
    if (files_.config.empty() && !recipe.config.empty())
      files_.config = (folder / recipe.config).string();
    if (files_.reference_mesh.empty() && !recipe.reference_mesh.empty())
      files_.reference_mesh = (folder / recipe.reference_mesh).string();
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

// make_for(): the subcommand of each kind of command; null if it has none.

template <class EditCommand>
requires(!EditCommand::beyond_table) std::unique_ptr<Subcommand> make_for(const EditCommand&,
                                                                          CLI::App& program) {
  return std::make_unique<TableSubcommand<EditCommand>>(program);
}

std::unique_ptr<Subcommand> make_for(const MoveCommand&, CLI::App& program) {
  return std::make_unique<MoveSubcommand>(program);
}

std::unique_ptr<Subcommand> make_for(const DeformCommand&, CLI::App& program) {
  return std::make_unique<DeformSubcommand>(program);
}

std::unique_ptr<Subcommand> make_for(const LayersCommand&, CLI::App& program) {
  return std::make_unique<LayersSubcommand>(program);
}

/// Virtual control volumes are edited in the studio and in recipes.
std::unique_ptr<Subcommand> make_for(const EditVcvCommand&, CLI::App&) { return nullptr; }

std::unique_ptr<Subcommand> make_replay_subcommand(CLI::App& program) {
  return std::make_unique<ReplaySubcommand>(program);
}

}  // namespace

SubcommandList make_subcommands(CLI::App& program) {
  SubcommandList list;
  for (const Command& command : all_commands()) {
    auto subcommand = std::visit([&](const auto& of) { return make_for(of, program); }, command);
    if (subcommand) list.push_back(std::move(subcommand));
  }
  for (auto* make : {make_sweep_subcommand, make_sensitivity_subcommand, make_quality_subcommand,
                     make_render_subcommand, make_convert_subcommand, make_replay_subcommand,
                     make_studio_subcommand, make_reference_subcommand}) {
    list.push_back(make(program));
  }
  return list;
}

}  // namespace winslow::app
