#pragma once

#include <string>
#include <vector>

namespace winslow::gui {

/// Marks of an axis.
struct Tick {
  double value = 0;
  std::string label;
};

/// Round numbers (1, 2, 5 times a power of ten) within [low, high], about `wanted` of them.
std::vector<Tick> linear_ticks(double low, double high, int wanted);
/// The same, whole numbers only.
std::vector<Tick> integer_ticks(double low, double high, int wanted);
/// Powers of ten from 10^low to 10^high, at most `wanted`.
std::vector<Tick> decade_ticks(int low, int high, int wanted);

}  // namespace winslow::gui
