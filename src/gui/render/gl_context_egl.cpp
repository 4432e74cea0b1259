#ifndef WINSLOW_HAS_OSMESA

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <mutex>
#include <string_view>

#include "core/error.h"
#include "gui/render/gl.h"
#include "gui/render/gl_context.h"

namespace winslow::gui {
namespace {

constexpr std::string_view hint =
    "; drawing without a display needs EGL and Mesa's drivers (Debian: apt-get install libegl1 "
    "libegl-mesa0 libgl1-mesa-dri)";

[[noreturn]] void fail(const std::string& what) { throw Error(what + std::string(hint)); }

bool has_extension(const char* list, std::string_view name) {
  return list != nullptr && std::string_view(list).find(name) != std::string_view::npos;
}

/// The surfaceless platform works with no display at all; the default display is the fallback for
/// drivers that do not know it.
EGLDisplay find_display() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (has_extension(extensions, "EGL_MESA_platform_surfaceless")) {
    const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_platform_display != nullptr) {
      const EGLDisplay display = get_platform_display(
          EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
      if (display != EGL_NO_DISPLAY) return display;
    }
  }
  return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

/// The display is the process's: EGL gives every caller the same one, and Mesa, closed and opened
/// again, loads its driver anew and loses the memory of the one before. So it is opened once.
EGLDisplay open_display() {
  static std::mutex mutex;
  static EGLDisplay display = EGL_NO_DISPLAY;
  const std::lock_guard lock(mutex);
  if (display != EGL_NO_DISPLAY) return display;
  const EGLDisplay found = find_display();
  if (found == EGL_NO_DISPLAY) fail("no EGL display");
  if (eglInitialize(found, nullptr, nullptr) == EGL_FALSE) fail("EGL does not start");
  display = found;
  return display;
}

class EglContext : public HeadlessContext {
 public:
  EglContext()
      : previous_display_(eglGetCurrentDisplay()),
        previous_context_(eglGetCurrentContext()),
        previous_draw_(eglGetCurrentSurface(EGL_DRAW)),
        previous_read_(eglGetCurrentSurface(EGL_READ)) {
    if (!has_extension(eglQueryString(display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) {
      fail("EGL cannot draw without a surface");
    }
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail("EGL offers no desktop OpenGL");
    const EGLConfig config = choose_config();
    constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               3,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               3,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) fail("EGL has no OpenGL 3.3 core context");
    try {
      if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
        fail("EGL cannot make its context current");
      }
      load_gl(eglGetProcAddress);
    } catch (...) {
      release();
      throw;
    }
  }
  ~EglContext() override { release(); }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  std::string description() const override {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return std::string("EGL surfaceless, ") + (renderer != nullptr ? renderer : "unknown renderer");
  }

 private:
  /// A context without surfaces needs no particular config; drivers without the extension that says
  /// so get the first one that can draw OpenGL.
  EGLConfig choose_config() const {
    constexpr std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                           EGL_PBUFFER_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (eglChooseConfig(display_, wanted.data(), &config, 1, &found) == EGL_TRUE && found > 0) {
      return config;
    }
    return EGL_NO_CONFIG_KHR;
  }

  void release() {
    if (previous_context_ != EGL_NO_CONTEXT) {
      eglMakeCurrent(previous_display_, previous_draw_, previous_read_, previous_context_);
    } else {
      eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display_, context_);
  }

  EGLDisplay display_ = open_display();
  EGLDisplay previous_display_;
  EGLContext previous_context_;
  EGLSurface previous_draw_, previous_read_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<HeadlessContext> make_headless_context() { return std::make_unique<EglContext>(); }

}  // namespace winslow::gui

#endif
