#pragma once

#include <string>
#include <vector>

namespace winslow::gui {

/// Round numbers (1, 2, 2.5 or 5 times a power of ten apart) within [low, high], about `wanted` of
/// them. Empty if the range is empty or not finite.
std::vector<double> nice_ticks(double low, double high, int wanted);

/// Round numbers within [low, high], both positive, evenly apart by their ratios, about `wanted` of
/// them: powers of ten, or 1, 2 and 5 times those. Of less than a decade those of nice_ticks().
std::vector<double> log_ticks(double low, double high, int wanted);

/// Next round number (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten) at or above a
/// positive value.
double round_up_nicely(double value);

/// "0.001", "20", "1e-06": three digits of a number that stands alone.
std::string format_power(double value);

/// As short as the distance to the neighbouring tick allows: "0.25", "100", "2e-7".
std::string format_tick(double value, double step);

}  // namespace winslow::gui
