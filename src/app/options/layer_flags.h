#pragma once

#include <CLI/CLI.hpp>

#include "core/command/command.h"
#include "core/layers/layer_plan.h"

namespace winslow::app {

/// The options that say where layers go and how high they are.
class LayerFlags {
 public:
  /// Declares --marker, --wall, --count, --first, ... This object must outlive the parsing.
  void declare(CLI::App& app);
  /// Puts the walls and overrides that were asked for into the options. Throws UsageError.
  void finish(LayerOptions& options) const;

 private:
  void declare_first_height(CLI::App& app);

  std::vector<std::string> markers_, walls_, columns_;
  LayerSpacing spacing_;
  std::optional<double> y_plus_, reynolds_;
  double length_ = 1;
};

/// Declares --hold-layers: walls whose layers keep their heights while bodies move.
void add_hold_layers_flag(CLI::App& app, std::vector<std::string>& markers);
/// The command, preceded by one that finds and holds the layers at these walls, if any are named.
std::vector<Command> holding_layers(const std::vector<std::string>& markers,
                                    const SmoothOptions& smooth, Command command);

/// "NAME[,NAME]:count=20,first=1e-5,...", what is not said as in `common`. Keys are those of
/// LayerSpacing and of WallPart. Throws UsageError.
LayerWall parse_wall(const std::string& text, const LayerSpacing& common);
/// "NODE:columns=3,thickness=0.01", of which one may be missing. Throws UsageError.
ColumnOverride parse_column(const std::string& text);

}  // namespace winslow::app
