#pragma once

#include "core/options/option.h"
#include "io/recipe/object_archive.h"

namespace winslow::io {

/// A vector of two numbers, or of three where there is a place for the third (not null). Throws
/// JsonValueError.
void read_vector(const nlohmann::json& value, const std::string& path, Vec2& plane,
                 std::optional<double>* third);
nlohmann::json vector_json(const Vec2& plane, const std::optional<double>* third);

/// Reads the options of a table from the keys that it says; what is not there stays as it is, but
/// for what is required. Throws JsonValueError for values of the wrong type or out of range.
void read_options(ObjectReader& reader, const OptionTable& table);
/// Writes all of them. What is not set is left out.
void write_options(ObjectWriter& writer, const OptionTable& table);

}  // namespace winslow::io
