#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/quality/quality.h"

namespace winslow::gui {

/// What the column on the right shows.
enum class SideTab { quality, view, vcv, history };

/// How the mesh is shown; no part of the document.
struct ViewOptions {
  std::optional<Metric> color = Metric::normalized_jacobian;  ///< none: plain
  std::string color_map = "viridis";
  int bands = 0;                               ///< 0: continuous
  std::optional<std::array<double, 2>> range;  ///< of the colours; none: automatic
  bool wireframe = true;
  bool nodes = false;
  bool legend = true;
  bool mark_inverted = true;
  bool left_panel = true;
  bool right_panel = true;
  SideTab side_tab = SideTab::quality;
  bool plot_panel = true;

  bool operator==(const ViewOptions&) const = default;
};

}  // namespace winslow::gui
