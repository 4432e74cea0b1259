#pragma once

#include "core/options/option.h"
#include "io/recipe/object_archive.h"

namespace winslow::io {

/// A vector of two numbers or of three. Throws JsonValueError.
GivenVector read_vector(const nlohmann::json& value, const std::string& path);
/// As many numbers as it was given by; `otherwise` of them if the program found it.
nlohmann::json vector_json(const GivenVector& vector, int otherwise = 3);

/// Reads the options of a table from the keys that it says; what is not there stays as it is, but
/// for what is required. Throws JsonValueError for values of the wrong type or out of range.
void read_options(ObjectReader& reader, const OptionTable& table);
/// Writes all of them. What is not set is left out.
void write_options(ObjectWriter& writer, const OptionTable& table);

}  // namespace winslow::io
