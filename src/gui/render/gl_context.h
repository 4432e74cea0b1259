#pragma once

#include <memory>
#include <string>

namespace winslow::gui {

/// An OpenGL 3.3 core context, current on the thread that made it and destroyed on that thread;
/// what was current before is current again afterwards. The window makes its own through GLFW
/// (gui/shell/window.h); this one needs no display. Its own framebuffer is undefined: draw into a
/// FrameBuffer.
class HeadlessContext {
 public:
  virtual ~HeadlessContext() = default;
  virtual std::string description() const = 0;  ///< "EGL surfaceless, llvmpipe ..."
};

/// EGL surfaceless, or OSMesa if the build says so. Throws Error saying what is missing and which
/// package brings it.
std::unique_ptr<HeadlessContext> make_headless_context();

}  // namespace winslow::gui
