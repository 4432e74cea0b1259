#pragma once

#include <memory>

#include "gui/base/screen.h"
#include "gui/render/image.h"

namespace winslow::gui {

/// An off-screen target: colour and depth, multisampled and resolved before it is read back.
class FrameBuffer {
 public:
  /// Sizes in pixels; samples per pixel (0 or 1: none), limited to what the machine supports.
  /// Throws UsageError for a size that it does not support.
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
  /// The pixels of a box in a framebuffer of that height.
  static Part part_of(const ScreenBox& box, int height);
  /// The framebuffer to which draw calls go now.
  static unsigned bound();
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

/// A picture kept from frame to frame, redrawn only when its key changes: everything on which it
/// depends.
template <class Key>
class KeptPicture {
 public:
  /// Makes the next show() redraw the picture.
  void forget() { key_.reset(); }
  void clear() { *this = KeptPicture(); }
  /// Shows a part of the picture in the bound framebuffer. draw: draws the picture into a
  /// framebuffer of that width and height, which is bound when it is called.
  template <class Draw>
  void show(const Key& key, const FrameBuffer::Part& part, int width, int height,
            const Draw& draw) {
    constexpr int samples = 4;
    const unsigned target = FrameBuffer::bound();
    if (key_ != key) {
      if (!buffer_ || buffer_->width() != width || buffer_->height() != height)
        buffer_ = std::make_unique<FrameBuffer>(width, height, samples);
      buffer_->bind();
      draw();
      buffer_->resolve(part);
      key_ = key;
    }
    buffer_->show(part, target);
  }

 private:
  std::unique_ptr<FrameBuffer> buffer_;
  std::optional<Key> key_;  // of what is in buffer_
};

}  // namespace winslow::gui
