#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/inspect/element_field.h"
#include "gui/render/image.h"

namespace winslow::gui {

/// A picture of a mesh, drawn without a display.
struct PictureOptions {
  int width = 1200, height = 900;              ///< pixels
  std::optional<ElementField> color;           ///< colour elements by this
  std::optional<Bounds> bounds;                ///< shown whole; default: the whole mesh
  std::optional<std::array<double, 2>> range;  ///< of the colours; default: automatic
  std::string color_map = "viridis";
  bool wireframe = true;
  bool legend = true;      ///< only with color
  bool marker_key = true;  ///< names of the markers in their colours, bottom left
  std::string title;       ///< top left; empty: none
  bool dark = false;
  int samples = 4;  ///< multisampling
};

/// Inverted elements are red and counted in a caption. Throws Error where no OpenGL can be had, and
/// UsageError for an unknown colour map, bounds or a range without extent, a size out of range.
Image draw_picture(const Mesh& mesh, const PictureOptions& options);

}  // namespace winslow::gui
