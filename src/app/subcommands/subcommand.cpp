#include "app/subcommands/subcommand.h"

namespace winslow::app {

SubcommandList make_subcommands(CLI::App& program) {
  SubcommandList list;
  for (auto* make : {make_smooth_subcommand, make_move_subcommand, make_deform_subcommand,
                     make_layers_subcommand, make_scramble_subcommand, make_quality_subcommand,
                     make_render_subcommand, make_convert_subcommand, make_replay_subcommand,
                     make_studio_subcommand, make_reference_subcommand}) {
    list.push_back(make(program));
  }
  return list;
}

}  // namespace winslow::app
