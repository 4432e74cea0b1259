#pragma once

#include "core/layers/layer_plan.h"
#include "io/recipe/object_archive.h"

namespace winslow::io {

/// Walls and overrides of layers. Reading checks all the options, of which the table has been read
/// before. Throws JsonValueError.
void read_layer_lists(ObjectReader& reader, LayerOptions& layers);
void write_layer_lists(ObjectWriter& writer, const LayerOptions& layers);

}  // namespace winslow::io
