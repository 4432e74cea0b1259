#pragma once

#include "gui/base/screen.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/render/image.h"
#include "gui/settings/picture_spec.h"

namespace winslow::gui {

/// What can be drawn as a picture.
class PictureSource {
 public:
  virtual ~PictureSource() = default;
  /// The window as it is.
  virtual Image picture() = 0;
  /// Throws UsageError for a size out of range, Error where OpenGL cannot.
  virtual Image picture(const PictureSpec& spec) = 0;
  /// The same of the mesh on screen with its nodes elsewhere (#nodes by 2).
  virtual Image picture_of(const Coordinates& nodes, const PictureSpec& spec) = 0;
  /// Width and height on screen, pixels, of what a picture shows.
  virtual ScreenVector picture_extent(const PictureSpec& spec) const = 0;
  /// The mesh alone, for vector graphics.
  virtual VectorFigure figure(bool legend) const = 0;
};

}  // namespace winslow::gui
