#pragma once

#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace winslow::gui {

/// Formats a number with printf, in at most 63 characters: formatted(0.5, "%.2f").
std::string formatted(double value, const char* format);
/// "12,345".
std::string grouped(long long value);
/// "1 element", "12,345 elements".
template <std::integral Count>
std::string counted(Count count, std::string_view noun) {
  return grouped(static_cast<long long>(count)) + " " + std::string(noun) + (count == 1 ? "" : "s");
}
/// "main, flap": joins texts with a separator.
std::string joined(std::span<const std::string> texts, std::string_view between = ", ");
/// Four significant digits, in the shorter of fixed and scientific notation.
std::string short_number(double value);
/// A number for a table: three decimals below 1000, scientific above; "-" if not finite.
std::string table_number(double value);

/// About `wanted` round numbers within [low, high], with a spacing of 1, 2, 2.5 or 5 times a power
/// of ten. Empty if the range is empty or not finite.
std::vector<double> nice_ticks(double low, double high, int wanted);

/// About `wanted` round numbers within [low, high], both positive, evenly spaced on a logarithmic
/// scale: powers of ten, or 1, 2 and 5 times these. For less than a decade those of nice_ticks().
std::vector<double> log_ticks(double low, double high, int wanted);

/// Next round number (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten) at or above a
/// positive value.
double round_up_nicely(double value);

/// "0.001", "20", "1e-06": a number with three digits.
std::string format_power(double value);

/// As short as the distance to the neighbouring tick allows: "0.25", "100", "2e-7".
std::string format_tick(double value, double step);

}  // namespace winslow::gui
