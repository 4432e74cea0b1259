#pragma once

#include "core/layers/layer_spacing.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/options/option.h"

/// Layers at two walls, of different heights:
///
///     winslow::LayerOptions options;
///     options.walls = {{{"main"}, {.count = 20, .first = 1e-4}}, {{"flap"}, {.count = 12}}};
///     winslow::LayersCommand insert;
///     insert.layers = options;
namespace winslow {

/// How layers go round corners and through gaps. The defaults need no touch.
struct LayerOptions {
  std::vector<LayerWall> walls;
  bool fans = true;           ///< several columns at sharp convex corners
  double fan_threshold = 60;  ///< turning of the wall from which there is a fan, degrees
  double fan_angle = 50;      ///< between neighbouring columns of a fan, degrees
  double clearance = 0.35;    ///< share of a gap's width that the layers of either side may take
  double crossing = 0.35;     ///< share of a wall edge that has to be left of it at the rim
  double steepest = 0.5;      ///< change of thickness along the wall, per length of wall
  /// Where there is less room than asked: all heights in proportion, the first as well; false: the
  /// first height stays, the ratios give way, and where even that is too thick there are fewer
  /// layers.
  bool scale_all = false;
  std::vector<ColumnOverride> overrides;

  bool operator==(const LayerOptions&) const = default;
};

/// Throws UsageError naming the number that is out of range.
void validate(const LayerOptions& options);

/// The options with the number of layers that a match with the elements outside takes: as many as
/// it is until the last layer is as high as the wall's edges (their median) are long.
LayerOptions with_counts(LayerOptions options, const Mesh& mesh);

/// Where columns will stand, in which direction, and how high each layer is to be; without nodes.
/// Thickness is limited by the room there is.
/// Throws UsageError: options out of range, an unknown marker, a marker inside the mesh, an
/// override of a node that is on no wall.
LayerStack plan_layers(const Mesh& mesh, const LayerOptions& options);

/// Takes room from some columns: what is left of it is multiplied by `factor`. Their neighbours get
/// less as well, as far as the steepest change of thickness wants, and heights are distributed
/// anew. options: with counts.
void take_room(LayerStack& stack, const std::vector<std::size_t>& columns, double factor,
               LayerLimit limit, const LayerOptions& options, const Coordinates& x);

/// All that a user can set of the heights of layers.
OptionTable option_table(LayerSpacing& spacing);
/// All that a user can set of where layers go, but for the walls and the overrides.
OptionTable option_table(LayerOptions& options);

}  // namespace winslow
