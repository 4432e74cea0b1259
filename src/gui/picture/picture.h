#pragma once

#include "core/inspect/element_field.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/render/color_scale.h"
#include "gui/render/image.h"

namespace winslow::gui {

/// A picture of a mesh, drawn without a display.
struct PictureOptions {
  int width = 1200, height = 900;     ///< pixels
  std::optional<ElementField> color;  ///< colour elements by this
  std::optional<Bounds> bounds;       ///< shown whole; default: the whole mesh
  /// Earlier nodes, for WallField::first_height_ratio; null: that field has no values.
  std::shared_ptr<const Coordinates> before;
  ColorChoice colors;  ///< of what is coloured; on_dark follows dark
  bool wireframe = true;
  bool legend = true;      ///< only with color
  bool marker_key = true;  ///< names of the markers in their colours, bottom left
  std::string title;       ///< top left; empty: none
  bool dark = false;
  std::vector<Index> vcvs;  ///< nodes whose virtual control volumes are drawn over the mesh
  int samples = 4;          ///< multisampling
};

/// Draws a picture; inverted elements are red and counted in a caption. Throws Error if OpenGL is
/// not available, and UsageError for an unknown colour map, a node without a VCV, bounds or a range
/// without extent, a size out of range.
Image draw_picture(const Mesh& mesh, const PictureOptions& options);

/// The same as vector graphics, one point per pixel of the options. Throws UsageError.
VectorFigure picture_figure(const Mesh& mesh, const PictureOptions& options);

/// The scale of the colours of a picture; pictures to compare should all use one scale. Needs
/// options.color.
ColorScale picture_scale(const Mesh& mesh, const PictureOptions& options);
/// Puts two pictures of the same height side by side.
Image side_by_side(const Image& left, const Image& right);

}  // namespace winslow::gui
