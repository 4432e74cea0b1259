#include "gui/base/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace winslow::gui {

std::string formatted(double value, const char* format) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

std::string grouped(long long value) {
  std::string digits = std::to_string(value < 0 ? -value : value);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return value < 0 ? "-" + digits : digits;
}

std::string joined(std::span<const std::string> texts, std::string_view between) {
  std::string all;
  for (const std::string& text : texts) all.append(all.empty() ? "" : between).append(text);
  return all;
}

std::string short_number(double value) { return formatted(value, "%.4g"); }

std::string table_number(double value) {
  if (!std::isfinite(value)) return "-";
  return formatted(value, std::abs(value) < 1000 ? "%.3f" : "%.2e");
}

namespace {

constexpr std::array<double, 4> tick_steps{1, 2, 2.5, 5};

std::string print(const char* format, int precision, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, precision, value);
  return text.data();
}

}  // namespace

std::vector<double> nice_ticks(double low, double high, int wanted) {
  const double span = high - low;
  if (!std::isfinite(span) || span <= 0 || wanted < 1) return {};
  const double target = span / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(target)));
  double step = 10 * power;
  for (const double candidate : tick_steps) {
    if (candidate * power >= target * (1 - 1e-9)) {
      step = candidate * power;
      break;
    }
  }
  std::vector<double> ticks;
  const double slack = 1e-9 * span;
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) {
    ticks.push_back(k * step);
    if (ticks.size() > 1000) break;  // the step is below the round-off of huge limits
  }
  return ticks;
}

std::vector<double> log_ticks(double low, double high, int wanted) {
  if (!(low > 0) || !(high > low) || !std::isfinite(high) || wanted < 1) return {};
  constexpr double slack = 1e-9;
  const double decades = std::log10(high / low);
  if (decades < 1) return nice_ticks(low, high, wanted);
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  const bool fine = 3 * decades <= wanted;
  const int step = std::max(1, static_cast<int>(std::ceil(decades / wanted)));
  std::vector<double> ticks;
  for (int k = first; k <= last; ++k)
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (digit > 1 ? !fine : k % step != 0) continue;
      const double value = digit * std::pow(10.0, k);
      if (value >= low * (1 - slack) && value <= high * (1 + slack)) ticks.push_back(value);
    }
  return ticks;
}

std::string format_power(double value) {
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e6) return print("%.*g", 3, value);
  // Three digits, but no exponent for the thousands.
  const double power = std::pow(10.0, std::floor(std::log10(size)) - 2);
  return print("%.*g", 6, power * std::round(value / power));
}

double round_up_nicely(double value) {
  if (!(value > 0) || !std::isfinite(value)) return value;
  constexpr std::array<double, 11> round{1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double candidate : round) {
    if (candidate * power >= value * (1 - 1e-12)) return candidate * power;
  }
  return 10 * power;
}

std::string format_tick(double value, double step) {
  const double size = std::max(std::abs(value), std::abs(step));
  if (std::abs(value) < 1e-9 * std::abs(step)) return "0";
  if (size >= 1e6 || size < 1e-4) {
    const double digits = std::log10(std::abs(value)) - std::log10(std::abs(step));
    return print("%.*g", std::clamp(static_cast<int>(std::ceil(digits)) + 2, 1, 15), value);
  }
  int decimals = 0;
  double scaled = std::abs(step);
  while (decimals < 9 && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled) {
    scaled *= 10;
    ++decimals;
  }
  return print("%.*f", decimals, value);
}

}  // namespace winslow::gui
