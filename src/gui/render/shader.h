#pragma once

#include <array>
#include <span>
#include <string_view>

#include "gui/render/gl.h"

namespace winslow::gui {

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

}  // namespace winslow::gui
