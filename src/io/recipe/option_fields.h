#pragma once

#include "core/options/option.h"
#include "io/recipe/object_archive.h"

namespace winslow::io {

/// Reads the options of a table from the keys that it says; what is not there stays as it is, but
/// for what is required. Throws JsonValueError for values of the wrong type or out of range.
void read_options(ObjectReader& reader, const OptionTable& table);
/// Writes all of them. What is not set is left out.
void write_options(ObjectWriter& writer, const OptionTable& table);

}  // namespace winslow::io
