#pragma once

#include <imgui.h>

#include "gui/render/gl.h"
#include "gui/render/image.h"

struct ImDrawData;

namespace winslow::gui {

/// Draws Dear ImGui's output with the bound OpenGL context into the bound framebuffer. Takes the
/// place of ImGui's own OpenGL backend, which opens libGL.so.1 by itself and so cannot draw through
/// OSMesa. Make it after the fonts have been added to the current ImGui context.
class ImGuiRenderer {
 public:
  ImGuiRenderer();
  ~ImGuiRenderer();
  ImGuiRenderer(const ImGuiRenderer&) = delete;
  ImGuiRenderer& operator=(const ImGuiRenderer&) = delete;

  /// Call again if the fonts have changed.
  void upload_fonts();
  void draw(const ImDrawData& data);

 private:
  void prepare(const ImDrawData& data, int width, int height);

  Shader shader_{"ui.vert", "ui.frag"};
  GlBuffer vertices_{GL_ARRAY_BUFFER}, indices_{GL_ELEMENT_ARRAY_BUFFER};
  GLuint vertex_array_ = 0;
  GLuint font_texture_ = 0;
};

/// A picture on the graphics card, for ImGui::Image. Needs a current OpenGL context.
class Texture {
 public:
  explicit Texture(const Image& image);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  ImTextureID id() const;

 private:
  unsigned texture_ = 0;
};

}  // namespace winslow::gui
