#include "gui/render/frame_buffer.h"

#include "core/error.h"
#include "gui/render/gl.h"

namespace winslow::gui {
namespace {

void check_complete(int width, int height) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error("OpenGL cannot draw a picture of " + std::to_string(width) + " x " +
                std::to_string(height) + " pixels");
  }
}

void check_size(int width, int height) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (width < 1 || height < 1 || width > largest || height > largest) {
    throw UsageError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels: each side must be between 1 and " + std::to_string(largest));
  }
}

void copy(GLuint from, GLuint to, const FrameBuffer::Part& part) {
  const GLint right = part.x + part.width;
  const GLint top = part.y + part.height;
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(part.x, part.y, right, top, part.x, part.y, right, top, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
}

}  // namespace

FrameBuffer::FrameBuffer(int width, int height, int samples)
    : width_(width), height_(height), samples_(samples) {
  check_size(width, height);
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  samples_ = std::clamp(samples, 0, static_cast<int>(most));
  glGenRenderbuffers(3, buffers_);
  glGenFramebuffers(1, &draw_fbo_);
  glGenFramebuffers(1, &read_fbo_);
  try {
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_[0]);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_RGBA8, width_, height_);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_[1]);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_DEPTH24_STENCIL8, width_,
                                     height_);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_[2]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_, height_);
    glBindFramebuffer(GL_FRAMEBUFFER, read_fbo_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[2]);
    check_complete(width_, height_);
    glBindFramebuffer(GL_FRAMEBUFFER, draw_fbo_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[0]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                              buffers_[1]);
    check_complete(width_, height_);
  } catch (...) {
    release();
    throw;
  }
  glViewport(0, 0, width_, height_);
}

FrameBuffer::~FrameBuffer() { release(); }

void FrameBuffer::release() {
  glDeleteFramebuffers(1, &draw_fbo_);
  glDeleteFramebuffers(1, &read_fbo_);
  glDeleteRenderbuffers(3, buffers_);
}

FrameBuffer::Part FrameBuffer::part_of(const ScreenBox& box, int height) {
  const auto x = static_cast<int>(std::lround(box.min.x()));
  const auto y = static_cast<int>(std::lround(box.min.y()));
  const auto part_width = static_cast<int>(std::lround(box.size().x()));
  const auto part_height = static_cast<int>(std::lround(box.size().y()));
  return {x, height - y - part_height, part_width, part_height};
}

unsigned FrameBuffer::bound() {
  GLint target = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  return static_cast<unsigned>(target);
}

void FrameBuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, draw_fbo_);
  glViewport(0, 0, width_, height_);
}

void FrameBuffer::clear(const std::array<float, 4>& color) const {
  bind();
  glDisable(GL_SCISSOR_TEST);
  glClearColor(color[0], color[1], color[2], color[3]);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void FrameBuffer::resolve(const Part& part) const { copy(draw_fbo_, read_fbo_, part); }

void FrameBuffer::show(const Part& part, unsigned target) const {
  copy(read_fbo_, target, part);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
}

Image FrameBuffer::read() const {
  resolve({0, 0, width_, height_});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, read_fbo_);
  Image image;
  image.width = width_;
  image.height = height_;
  const auto row = 4 * static_cast<std::size_t>(width_);
  const auto rows = static_cast<std::size_t>(height_);
  std::vector<std::uint8_t> upside_down(row * rows);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.data());
  glBindFramebuffer(GL_FRAMEBUFFER, draw_fbo_);
  image.rgba.resize(upside_down.size());
  for (std::size_t y = 0; y < rows; ++y) {
    std::copy_n(upside_down.data() + row * (rows - 1 - y), row, image.rgba.data() + row * y);
  }
  return image;
}

}  // namespace winslow::gui
