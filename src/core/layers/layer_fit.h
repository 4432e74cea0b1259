#pragma once

#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"

namespace winslow {

/// The layers with heights that there is room for when the walls are where `moved` has them. Where
/// walls have come nearer to one another, layers are made thinner, as those beside them are, gently
/// along the wall; where they have gone apart again, heights return to those that were granted.
/// The number of layers stays. Columns stand on the walls as these are in `moved`.
/// x, moved: #nodes by 2, of which the boundary nodes count.
LayerStack fitted_layers(const LayerStack& stack, const Topology& topology, const Coordinates& x,
                         const Coordinates& moved);

/// Heights of layers (none zero) made thinner, to add up to `thickness`: the ratios to the first
/// give way, and where even layers as high as the first are too thick, all are of one height.
/// Heights that do not grow are made thinner in proportion.
std::vector<double> thinned(std::span<const double> heights, double thickness);

/// The plan by which layers are inserted: as plan_layers(), and where neighbouring columns would
/// cross they are made thinner until they do not. options: with counts. Throws as plan_layers().
LayerStack sound_plan(const Mesh& mesh, const LayerOptions& options);

}  // namespace winslow
