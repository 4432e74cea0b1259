#pragma once

#include <imgui.h>

#include "gui/render/image.h"

namespace winslow::gui {

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
