#pragma once

#include <span>
#include <string>

#include "core/inspect/element_field.h"
#include "core/quality/quality.h"
#include "gui/render/color_map.h"

namespace winslow::gui {

/// The colours in which a metric is shown unless the user chose a range: bad elements dark, good
/// ones bright. Normalized Jacobian: 0 to 1. Aspect ratio and condition number: from 1 to a round
/// number above all but the worst half percent (at least 1.5), so that a single sliver does not
/// wash out the rest; kappa likewise. Area: to the same percentile. Residual: from 0 to that
/// percentile. Smallest weight: to 1, from 0 or the worst half percent if that is less. Values that
/// are not finite are left out. Fields with a sign (sine, area, smallest weight) have the middle of
/// a diverging map at zero: negative ones are orange.
ColorScale automatic_scale(const ElementField& field, std::span<const double> values,
                           const std::string& map = "viridis");

/// Counts of values in equal bins over the scale's range; values beyond it count in the last bin on
/// their side, those that are not finite nowhere.
Histogram histogram_over(std::span<const double> values, const ColorScale& scale, int bins);

}  // namespace winslow::gui
