#include "gui/view/mesh/isolated_elements.h"

#include <algorithm>

namespace winslow::gui {

long long isolated_count(std::span<const double> values, const Isolation& isolation) {
  return std::ranges::count_if(values, [&](double v) { return isolated(v, isolation); });
}

std::vector<float> element_opacity(std::span<const double> values, const Isolation& isolation) {
  if (!isolation.on) return {};
  std::vector<float> opacity;
  opacity.reserve(values.size());
  for (const double v : values)
    opacity.push_back(isolated(v, isolation) ? 1.0f : static_cast<float>(isolation.rest));
  return opacity;
}

Isolation isolation_for(const ElementField& field) {
  Isolation isolation;
  isolation.above = !field_info(field).larger_is_better;
  isolation.threshold = field_info(field).threshold;
  return isolation;
}

}  // namespace winslow::gui
