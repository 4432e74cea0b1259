#include "app/subcommands/subcommand.h"

#include <type_traits>

#include "app/subcommands/table_subcommand.h"

namespace winslow::app {
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
