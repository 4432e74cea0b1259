#pragma once

#include <array>

#include "gui/render/image.h"

namespace winslow::gui {

/// An off-screen target: colour and depth, multisampled and resolved before it is read back.
class FrameBuffer {
 public:
  /// Sizes in pixels; samples per pixel (0 or 1: none), lowered to what the machine can do. Throws
  /// UsageError for a size outside what it can do.
  FrameBuffer(int width, int height, int samples);
  ~FrameBuffer();
  FrameBuffer(const FrameBuffer&) = delete;
  FrameBuffer& operator=(const FrameBuffer&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Draw calls go here from now on; sets the viewport.
  void bind() const;
  /// Binds and clears all of it.
  void clear(const std::array<float, 4>& color) const;
  /// A part in pixels, y up as OpenGL counts them.
  struct Part {
    int x, y, width, height;
  };
  /// Averages the samples of a part, for show(); leaves another target bound.
  void resolve(const Part& part) const;
  /// Copies a part that is resolved to the same place of another target, which is bound then.
  void show(const Part& part, unsigned target) const;
  /// Resolves and reads the colours; stays bound.
  Image read() const;

 private:
  void release();

  int width_, height_, samples_;
  unsigned draw_fbo_ = 0, read_fbo_ = 0;
  unsigned buffers_[3] = {0, 0, 0};
};

}  // namespace winslow::gui
