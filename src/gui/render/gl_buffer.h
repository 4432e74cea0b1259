#pragma once

#include <span>

#include "gui/render/gl.h"

namespace winslow::gui {

/// A buffer of the graphics card. Content of the same size is updated in place.
class GlBuffer {
 public:
  explicit GlBuffer(GLenum target) : target_(target) { glGenBuffers(1, &id_); }
  ~GlBuffer() { glDeleteBuffers(1, &id_); }
  GlBuffer(const GlBuffer&) = delete;
  GlBuffer& operator=(const GlBuffer&) = delete;

  void bind() const { glBindBuffer(target_, id_); }
  GLuint id() const { return id_; }
  std::size_t bytes() const { return bytes_; }

  template <class T>
  void upload(std::span<const T> data) {
    bind();
    if (data.size_bytes() == bytes_ && bytes_ > 0) {
      glBufferSubData(target_, 0, static_cast<GLsizeiptr>(bytes_), data.data());
    } else {
      bytes_ = data.size_bytes();
      glBufferData(target_, static_cast<GLsizeiptr>(bytes_), data.data(), GL_DYNAMIC_DRAW);
    }
  }

 private:
  GLenum target_;
  GLuint id_ = 0;
  std::size_t bytes_ = 0;
};

/// A buffer that a shader reads by index.
class GlTextureBuffer {
 public:
  explicit GlTextureBuffer(GLenum format) : buffer_(GL_TEXTURE_BUFFER), format_(format) {
    glGenTextures(1, &texture_);
  }
  ~GlTextureBuffer() { glDeleteTextures(1, &texture_); }
  GlTextureBuffer(const GlTextureBuffer&) = delete;
  GlTextureBuffer& operator=(const GlTextureBuffer&) = delete;

  template <class T>
  void upload(std::span<const T> data) {
    buffer_.upload(data);
    glBindTexture(GL_TEXTURE_BUFFER, texture_);
    glTexBuffer(GL_TEXTURE_BUFFER, format_, buffer_.id());
  }
  void bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_BUFFER, texture_);
  }

 private:
  GlBuffer buffer_;
  GLenum format_;
  GLuint texture_ = 0;
};

}  // namespace winslow::gui
