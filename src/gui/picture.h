#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/quality/quality.h"
#include "gui/render/image.h"

namespace winslow::gui {

/// A picture of a mesh, drawn without a display.
struct PictureOptions {
  int width = 1200, height = 900;      ///< pixels
  std::optional<Metric> color;         ///< colour elements by this metric
  std::optional<Bounds> bounds;        ///< default: the whole mesh
  std::optional<std::array<double, 2>> range;  ///< of the colours; default: automatic
  std::string color_map = "viridis";
  bool wireframe = true;
  bool legend = true;                  ///< only with color
  std::string title;                   ///< empty: none
  bool dark = false;
  int samples = 4;                     ///< multisampling
};

/// Throws Error where no OpenGL can be had.
Image draw_picture(const Mesh& mesh, const PictureOptions& options);

}  // namespace winslow::gui
