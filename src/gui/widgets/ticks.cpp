#include "gui/widgets/ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace winslow::gui {

namespace {

std::string formatted(const char* format, double value) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

double nice_step(double span, int wanted) {
  const double raw = span / std::max(wanted, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::vector<Tick> ticks_at(double low, double high, double step) {
  std::vector<Tick> ticks;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    ticks.push_back({k * step, formatted("%.6g", k * step)});
  return ticks;
}

}  // namespace

std::vector<Tick> linear_ticks(double low, double high, int wanted) {
  if (!(high > low)) return {{low, formatted("%.6g", low)}};
  return ticks_at(low, high, nice_step(high - low, wanted));
}

std::vector<Tick> integer_ticks(double low, double high, int wanted) {
  if (!(high > low)) return {{low, formatted("%.0f", low)}};
  return ticks_at(low, high, std::max(1.0, nice_step(high - low, wanted)));
}

std::vector<Tick> decade_ticks(int low, int high, int wanted) {
  const int step = std::max(1, (high - low + wanted - 1) / std::max(wanted, 1));
  std::vector<Tick> ticks;
  for (int e = low; e <= high; ++e)
    if (e % step == 0) ticks.push_back({std::pow(10.0, e), formatted("1e%.0f", e)});
  return ticks;
}

}  // namespace winslow::gui
