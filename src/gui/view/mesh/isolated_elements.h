#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/inspect/element_field.h"
#include "gui/settings/view_options.h"

/// Which elements stay when some are isolated by their values of a metric.
namespace winslow::gui {

inline bool isolated(double value, const Isolation& isolation) {
  return isolation.above ? value > isolation.threshold : value < isolation.threshold;
}
long long isolated_count(std::span<const double> values, const Isolation& isolation);
/// Per element: 1 if it stays, else the opacity of the others; empty if nothing is isolated.
std::vector<float> element_opacity(std::span<const double> values, const Isolation& isolation);
/// Off, with the threshold and the side that single out bad elements by a field.
Isolation isolation_for(const ElementField& field);

}  // namespace winslow::gui
