#pragma once

#include "gui/render/image.h"

namespace winslow::gui {

/// An off-screen target: colour and depth, multisampled and resolved before it is read back.
class FrameBuffer {
 public:
  FrameBuffer(int width, int height, int samples);
  ~FrameBuffer();
  FrameBuffer(const FrameBuffer&) = delete;
  FrameBuffer& operator=(const FrameBuffer&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Draw calls go here from now on; sets the viewport.
  void bind() const;
  Image read() const;

 private:
  int width_, height_, samples_;
  unsigned draw_fbo_ = 0, read_fbo_ = 0;
  unsigned buffers_[3] = {0, 0, 0};
};

}  // namespace winslow::gui
