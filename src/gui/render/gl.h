#pragma once

#include <glad/gl.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace winslow::gui {

/// Looks up an OpenGL function by name: eglGetProcAddress, glfwGetProcAddress,
/// OSMesaGetProcAddress.
using GlLoader = GLADloadfunc;

/// Loads OpenGL for the context that is current on this thread. Call it once for every context
/// made. Throws Error if the context offers less than OpenGL 3.3.
void load_gl(GlLoader loader);

/// Sets alpha blending for what is drawn from now on, and draws triangles from either side.
void draw_over();

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

/// A file of shaders/, built into the program.
struct ShaderSource {
  std::string_view name;  ///< "fill.vert"
  std::string_view text;
};
std::span<const ShaderSource> embedded_shaders();

/// A linked program made of embedded shaders, one per stage (the stage is the file's extension).
class Shader {
 public:
  /// Throws Error with the compiler's log.
  explicit Shader(std::initializer_list<std::string_view> files);
  ~Shader();
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;

  void use() const { glUseProgram(program_); }
  /// Uniforms of the program; use() it first. A name that the compiler removed is ignored.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, float x, float y) const;
  void set(const char* name, const std::array<float, 4>& value) const;
  void set(const char* name, const std::array<float, 16>& matrix) const;

 private:
  int location(const char* name) const { return glGetUniformLocation(program_, name); }
  GLuint program_ = 0;
};

/// An OpenGL 3.3 core context, current on the thread that made it and destroyed on that thread;
/// what was current before is current again afterwards. The window makes its own through GLFW
/// (gui/shell/window.h); this one needs no display. Its own framebuffer is undefined: draw into a
/// FrameBuffer.
class HeadlessContext {
 public:
  virtual ~HeadlessContext() = default;
  virtual std::string description() const = 0;  ///< "EGL surfaceless, llvmpipe ..."
};

/// The name of the renderer of the current context, "llvmpipe ...".
std::string renderer_name();

/// Makes a context: EGL surfaceless, or OSMesa if the build is configured so. Throws Error that
/// names what is missing and its package.
std::unique_ptr<HeadlessContext> make_headless_context();

}  // namespace winslow::gui
