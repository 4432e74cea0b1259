#pragma once

#include "core/layers/layer_plan.h"

/// Layers on the walls of a volume mesh:
///
///     winslow::LayerOptions options;
///     options.walls = {{{"wing"}, {.count = 20, .first = 1e-5}}};
///     const winslow::LayerStack plan = winslow::plan_volume_layers(mesh, options);
namespace winslow {

/// Plans the columns of layers on the walls of a volume mesh, one at each wall node, with their
/// directions, heights and faces; without nodes.
///
/// Where there is less room than asked, layers become thinner: the first height stays and the
/// ratios are reduced; where even constant heights are too thick, all heights of the column are
/// scaled. The number of layers stays, and LayerColumn::limit names the reason. The rules, all by
/// LayerOptions where nothing else is said:
/// - a gap: at most `clearance` of its width (BallClearance);
/// - each face of a wall keeps .45 of its area at the rim, along its normal;
/// - each edge of a wall keeps .65 of its length at the rim, along the edge (more by `crossing`);
/// - thickness changes along the wall by `steepest` at most;
/// - a column along an edge of a curved boundary takes .6 of that edge.
/// Layers become thinner, too, where along straight columns a corner of an element has less than .2
/// of its volume in a right prism, and around an element outside with all its nodes on the rim that
/// would lose more than .8 of its volume.
/// Fans are not planned: see column_directions() for ridges that are too sharp for one column.
///
/// Throws UsageError for options out of range, all that find_wall_surface() and
/// column_directions() refuse, walls that meet with different numbers of layers, overrides that
/// volume meshes cannot have, and a place where not even layers of a tenth of the first height have
/// room.
LayerStack plan_volume_layers(const Mesh& mesh, const LayerOptions& options);

}  // namespace winslow
