#pragma once

#include <string_view>
#include <vector>

#include "gui/widgets/theme.h"

namespace winslow::gui::ui {

/// Heights of layers, from the wall outwards, in units of the mesh.
struct LayerHeights {
  std::vector<double> wanted;    ///< a line
  std::vector<double> realised;  ///< dots; empty: none yet
};

/// A small plot of height over the number of the layer, as wide as the row.
void height_plot(std::string_view id, const LayerHeights& heights, const Theme& theme);

}  // namespace winslow::gui::ui
