#include "gui/render/gl.h"

#include <string>

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

}  // namespace winslow::gui
