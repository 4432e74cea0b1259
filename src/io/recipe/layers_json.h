#pragma once

#include "core/command/command.h"
#include "io/recipe/object_archive.h"

namespace winslow::io {

/// What a recipe says of layers, but for how they are smoothed. Throws JsonValueError.
LayersCommand read_layers(ObjectReader& reader);
void write_layers(ObjectWriter& writer, const LayersCommand& command);

}  // namespace winslow::io
