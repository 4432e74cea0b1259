#include "gui/render/gl.h"

#include <algorithm>
#include <vector>

#include "core/error.h"

namespace winslow::gui {

void load_gl(GlLoader loader) {
  const int version = gladLoadGL(loader);
  const int major = GLAD_VERSION_MAJOR(version);
  const int minor = GLAD_VERSION_MINOR(version);
  if (version == 0) {
    throw Error("OpenGL could not be loaded (Debian: install libgl1-mesa-dri)");
  }
  if (major < 3 || (major == 3 && minor < 3)) {
    throw Error("OpenGL 3.3 is needed, this machine offers " + std::to_string(major) + "." +
                std::to_string(minor));
  }
}

std::string renderer_name() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr ? name : "unknown renderer";
}

void draw_over() {
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

namespace {

std::string_view find_source(std::string_view name) {
  const auto shaders = embedded_shaders();
  const auto found =
      std::ranges::find_if(shaders, [&](const ShaderSource& s) { return s.name == name; });
  if (found == shaders.end()) throw Error("no shader named " + std::string(name));
  return found->text;
}

GLenum stage_of(std::string_view name) {
  if (name.ends_with(".vert")) return GL_VERTEX_SHADER;
  if (name.ends_with(".geom")) return GL_GEOMETRY_SHADER;
  return GL_FRAGMENT_SHADER;
}

GLuint compile(std::string_view name) {
  const std::string_view text = find_source(name);
  const GLuint shader = glCreateShader(stage_of(name));
  const char* data = text.data();
  const auto length = static_cast<GLint>(text.size());
  glShaderSource(shader, 1, &data, &length);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    std::string log(2048, '\0');
    GLsizei size = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &size, log.data());
    log.resize(static_cast<std::size_t>(size));
    glDeleteShader(shader);
    throw Error("shader " + std::string(name) + " does not compile: " + log);
  }
  return shader;
}

}  // namespace

Shader::Shader(std::initializer_list<std::string_view> files) : program_(glCreateProgram()) {
  try {
    for (const std::string_view file : files) {
      const GLuint shader = compile(file);
      glAttachShader(program_, shader);
      glDeleteShader(shader);
    }
    glLinkProgram(program_);
    GLint good = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &good);
    if (good == 0) {
      std::string log(2048, '\0');
      GLsizei size = 0;
      glGetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), &size, log.data());
      log.resize(static_cast<std::size_t>(size));
      throw Error("shader " + std::string(*files.begin()) + " does not link: " + log);
    }
  } catch (...) {
    glDeleteProgram(program_);
    throw;
  }
}

Shader::~Shader() { glDeleteProgram(program_); }

void Shader::set(const char* name, int value) const { glUniform1i(location(name), value); }
void Shader::set(const char* name, float value) const { glUniform1f(location(name), value); }
void Shader::set(const char* name, float x, float y) const { glUniform2f(location(name), x, y); }
void Shader::set(const char* name, const std::array<float, 4>& value) const {
  glUniform4fv(location(name), 1, value.data());
}
void Shader::set(const char* name, const std::array<float, 16>& matrix) const {
  glUniformMatrix4fv(location(name), 1, GL_FALSE, matrix.data());
}

}  // namespace winslow::gui
