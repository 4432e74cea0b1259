#pragma once

#include <cmath>

#include "gui/widgets/controls.h"

namespace winslow::gui {

/// Share of a row that labels take in the panel of layers.
constexpr float layer_label_share = 0.46f;

/// A row for a number; what is typed counts once it is finite.
inline void layer_field(const char* id, const char* label, double& value, const char* tip) {
  ui::row(label, tip, layer_label_share);
  double typed = value;
  if (ui::number(id, typed, tip) && std::isfinite(typed)) value = typed;
}

}  // namespace winslow::gui
