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

/// The layers at walls: their heights, and the rules for corners and gaps, whose defaults suit most
/// meshes.
struct LayerOptions {
  std::vector<LayerWall> walls;
  bool fans = true;           ///< several columns at sharp convex corners
  double fan_threshold = 60;  ///< turning of the wall from which there is a fan, degrees
  double fan_angle = 50;      ///< between neighbouring columns of a fan, degrees
  double clearance = 0.35;    ///< largest share of the width of a gap for the layers of each side
  double crossing = 0.35;     ///< smallest length at the rim over that of the wall edge
  double steepest = 0.5;      ///< change of thickness along the wall, per length of wall
  /// Where there is less room than asked: true scales all heights, the first as well; false keeps
  /// the first height and reduces the ratios, and then the number of layers if necessary.
  bool scale_all = false;
  std::vector<ColumnOverride> overrides;

  bool operator==(const LayerOptions&) const = default;
};

/// Throws UsageError naming the number that is out of range.
void validate(const LayerOptions& options);

/// The options with `count` set for walls with match_outside: the number of layers until the last
/// one has the height of equilateral triangles, or regular tetrahedra, on the median edge of the
/// wall.
LayerOptions with_counts(LayerOptions options, const Mesh& mesh);

/// Plans the columns of layers with their directions and heights; without nodes. The thickness is
/// limited by the room.
/// Throws UsageError: options out of range, an unknown marker, a marker inside the mesh, an
/// override of a node that is on no wall.
LayerStack plan_layers(const Mesh& mesh, const LayerOptions& options);

/// Multiplies the room of some columns by `factor`. Their neighbours are limited, too, as the
/// steepest change of thickness requires, and all heights are set anew. options: with counts.
void reduce_room(LayerStack& stack, const std::vector<std::size_t>& columns, double factor,
                 LayerLimit limit, const LayerOptions& options, const Coordinates& x);

/// The settings of the heights of layers.
OptionTable option_table(LayerSpacing& spacing);
/// The settings of layers without the walls and the overrides.
OptionTable option_table(LayerOptions& options);

/// Fits layers to walls that have moved: directions of columns are those on the walls in `moved`,
/// and heights fit the room there. Where walls have come nearer to each other, layers become
/// thinner, with a gentle change along the wall; where they have moved apart again, heights return
/// to the granted ones. The number of layers stays. x, moved: #nodes by 2; only boundary nodes
/// matter.
LayerStack fitted_layers(const LayerStack& stack, const Topology& topology, const Coordinates& x,
                         const Coordinates& moved);

/// Reduces heights of layers (none zero) so that their sum is `thickness`. The ratios to the first
/// height are reduced; if even layers as high as the first are too thick, all get the same height.
/// Heights that do not grow are scaled.
std::vector<double> thinned(std::span<const double> heights, double thickness);

/// The plan by which layers are inserted: that of plan_layers(), with columns made thinner until no
/// neighbouring columns cross. options: with counts. Throws as plan_layers().
LayerStack sound_plan(const Mesh& mesh, const LayerOptions& options);

}  // namespace winslow
