#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace winslow::io {

/// Integer that fills the whole text ("+7" is accepted); nothing if it is none or too large.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Number that fills the whole text, to the nearest double, whatever the locale; "nan" and "inf"
/// are numbers here, and so is Fortran's "1.5D+03". Too small becomes zero or subnormal, too large
/// infinite.
std::optional<double> parse_number(std::string_view text);

/// Shortest decimal text that parse_number turns into the same double.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::int64_t value);

}  // namespace winslow::io
