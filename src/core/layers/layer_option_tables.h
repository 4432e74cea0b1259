#pragma once

#include "core/layers/layer_plan.h"
#include "core/options/option.h"

namespace winslow {

/// All that a user can set of the heights of layers.
OptionTable option_table(LayerSpacing& spacing);
/// All that a user can set of where layers go, but for the walls and the overrides.
OptionTable option_table(LayerOptions& options);

}  // namespace winslow
