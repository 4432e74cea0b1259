#include "gui/render/imgui_renderer.h"

#include <algorithm>
#include <cstddef>

namespace winslow::gui {
namespace {

std::array<float, 16> screen_matrix(const ImDrawData& data) {
  const float left = data.DisplayPos.x;
  const float top = data.DisplayPos.y;
  std::array<float, 16> m{};
  m[0] = 2.0f / data.DisplaySize.x;
  m[5] = -2.0f / data.DisplaySize.y;
  m[10] = -1.0f;
  m[12] = -1.0f - left * m[0];
  m[13] = 1.0f - top * m[5];
  m[15] = 1.0f;
  return m;
}

/// Sets the scissor to a command's rectangle; false if nothing of it is on the screen.
bool set_scissor(const ImDrawData& data, const ImDrawCmd& command, int width, int height) {
  const ImVec2 scale = data.FramebufferScale;
  const auto pixel = [](float v) { return static_cast<int>(v); };
  const int x0 = std::max(pixel((command.ClipRect.x - data.DisplayPos.x) * scale.x), 0);
  const int y0 = std::max(pixel((command.ClipRect.y - data.DisplayPos.y) * scale.y), 0);
  const int x1 = std::min(pixel((command.ClipRect.z - data.DisplayPos.x) * scale.x), width);
  const int y1 = std::min(pixel((command.ClipRect.w - data.DisplayPos.y) * scale.y), height);
  if (x1 <= x0 || y1 <= y0) return false;
  glScissor(x0, height - y1, x1 - x0, y1 - y0);
  return true;
}

ImTextureID texture_id(GLuint texture) {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
}

}  // namespace

ImGuiRenderer::ImGuiRenderer() {
  ImGuiIO& io = ImGui::GetIO();
  io.BackendRendererName = "winslow";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  glGenVertexArrays(1, &vertex_array_);
  glBindVertexArray(vertex_array_);
  vertices_.bind();
  indices_.bind();
  constexpr auto stride = static_cast<GLsizei>(sizeof(ImDrawVert));
  const auto at = [](std::size_t offset) { return reinterpret_cast<const void*>(offset); };
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, at(offsetof(ImDrawVert, pos)));
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, at(offsetof(ImDrawVert, uv)));
  glEnableVertexAttribArray(2);
  glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, at(offsetof(ImDrawVert, col)));
  glBindVertexArray(0);
  upload_fonts();
}

ImGuiRenderer::~ImGuiRenderer() {
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteTextures(1, &font_texture_);
}

void ImGuiRenderer::upload_fonts() {
  unsigned char* pixels = nullptr;
  int width = 0;
  int height = 0;
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.GetTexDataAsRGBA32(&pixels, &width, &height);
  if (font_texture_ == 0) glGenTextures(1, &font_texture_);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, font_texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  atlas.SetTexID(texture_id(font_texture_));
  // The texture holds the fonts now. The copies take up to 32 MB in large pictures, plus every
  // font's file.
  atlas.ClearTexData();
  atlas.ClearInputData();
}

void ImGuiRenderer::prepare(const ImDrawData& data, int width, int height) {
  glViewport(0, 0, width, height);
  glEnable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  draw_over();
  glBindVertexArray(vertex_array_);
  shader_.use();
  shader_.set("to_clip", screen_matrix(data));
  shader_.set("glyphs", 0);
  glActiveTexture(GL_TEXTURE0);
}

void ImGuiRenderer::draw(const ImDrawData& data) {
  const auto width = static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x);
  const auto height = static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y);
  if (width <= 0 || height <= 0) return;
  prepare(data, width, height);
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    vertices_.upload(std::span<const ImDrawVert>(list.VtxBuffer.begin(), list.VtxBuffer.end()));
    indices_.upload(std::span<const ImDrawIdx>(list.IdxBuffer.begin(), list.IdxBuffer.end()));
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback != nullptr) {
        // The callback may change any state of OpenGL.
        command.UserCallback(&list, &command);
        prepare(data, width, height);
        vertices_.bind();
        indices_.bind();
        continue;
      }
      if (!set_scissor(data, command, width, height)) continue;
      const auto id = reinterpret_cast<std::uintptr_t>(command.GetTexID());
      glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(id));
      glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                               GL_UNSIGNED_SHORT,
                               reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                               static_cast<GLint>(command.VtxOffset));
    }
  }
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
}

Texture::Texture(const Image& image) {
  glGenTextures(1, &texture_);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.rgba.data());
}

Texture::~Texture() { glDeleteTextures(1, &texture_); }

ImTextureID Texture::id() const {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_));
}

}  // namespace winslow::gui
