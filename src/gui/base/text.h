#pragma once

#include <concepts>
#include <span>
#include <string>
#include <string_view>

namespace winslow::gui {

/// By printf, in at most 63 characters: formatted(0.5, "%.2f").
std::string formatted(double value, const char* format);
/// "12,345".
std::string grouped(long long value);
/// "1 element", "12,345 elements".
template <std::integral Count>
std::string counted(Count count, std::string_view noun) {
  return grouped(static_cast<long long>(count)) + " " + std::string(noun) + (count == 1 ? "" : "s");
}
/// "main, flap": what is between two of them stands between all.
std::string joined(std::span<const std::string> texts, std::string_view between = ", ");
/// Four significant digits, in the shorter of fixed and scientific notation.
std::string short_number(double value);
/// A column of a table: three decimals below 1000, scientific above; "-" for what is not finite.
std::string table_number(double value);

}  // namespace winslow::gui
