#pragma once

#include "core/layers/layer_plan.h"

namespace winslow {

/// The plan by which layers are inserted: as plan_layers(), and where neighbouring columns would
/// cross they are made thinner until they do not. options: with counts. Throws as plan_layers().
LayerStack sound_plan(const Mesh& mesh, const LayerOptions& options);

}  // namespace winslow
