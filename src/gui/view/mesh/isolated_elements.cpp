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
  const auto is = [&](const ElementField& other) { return field == other; };
  const bool ratio = is(Metric::aspect_ratio) || is(Metric::condition_number);
  isolation.above =
      ratio || is(NodalField::kappa) || is(NodalField::residual) || field.layer() != nullptr;
  isolation.threshold = 0.5;
  if (ratio || is(NodalField::kappa)) isolation.threshold = 1.5;
  if (is(NodalField::residual) || is(LayerField::spacing_error)) isolation.threshold = 0.01;
  if (is(Metric::area) || is(NodalField::smallest_weight)) isolation.threshold = 0;
  return isolation;
}

}  // namespace winslow::gui
