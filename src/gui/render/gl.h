#pragma once

#include <glad/gl.h>

namespace winslow::gui {

/// Looks up an OpenGL function by name: eglGetProcAddress, glfwGetProcAddress,
/// OSMesaGetProcAddress.
using GlLoader = GLADloadfunc;

/// Loads OpenGL for the context that is current on this thread. Call it once for every context
/// made. Throws Error if the context offers less than OpenGL 3.3.
void load_gl(GlLoader loader);

}  // namespace winslow::gui
