#include "gui/render/gl.h"

#ifdef WINSLOW_HAS_OSMESA

// The loader's header stands in for GL/gl.h, which osmesa.h would include; besides the types,
// osmesa.h needs only these two macros from there.
#ifndef GLAPI
#define GLAPI extern
#endif
#ifndef GLAPIENTRY
#define GLAPIENTRY
#endif
#include <GL/osmesa.h>

#include <array>
#include <vector>

#include "core/error.h"

namespace winslow::gui {
namespace {

constexpr const char* hint =
    "; drawing without a display needs OSMesa (Debian: apt-get install libosmesa6)";

class OsmesaContext : public HeadlessContext {
 public:
  OsmesaContext() {
    constexpr std::array<int, 11> attributes{OSMESA_FORMAT,
                                             OSMESA_RGBA,
                                             OSMESA_PROFILE,
                                             OSMESA_CORE_PROFILE,
                                             OSMESA_CONTEXT_MAJOR_VERSION,
                                             3,
                                             OSMESA_CONTEXT_MINOR_VERSION,
                                             3,
                                             OSMESA_DEPTH_BITS,
                                             24,
                                             0};
    context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (context_ == nullptr) throw Error(std::string("no OpenGL 3.3 core context") + hint);
    try {
      make_current();
      load_gl(OSMesaGetProcAddress);
    } catch (...) {
      OSMesaDestroyContext(context_);
      throw;
    }
    innermost() = this;
  }
  ~OsmesaContext() override {
    innermost() = outer_;
    if (outer_ != nullptr) {
      outer_->make_current();
    } else {
      OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    }
    OSMesaDestroyContext(context_);
  }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  std::string description() const override { return "OSMesa, " + renderer_name(); }

 private:
  /// OSMesa cannot report the target of its current context, so this class remembers it.
  static OsmesaContext*& innermost() {
    static thread_local OsmesaContext* instance = nullptr;
    return instance;
  }
  void make_current() {
    if (OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, side, side) == GL_FALSE) {
      throw Error(std::string("OSMesa cannot make its context current") + hint);
    }
  }

  static constexpr int side = 16;
  OsmesaContext* outer_ = innermost();
  OSMesaContext context_ = nullptr;
  std::vector<unsigned char> pixels_ = std::vector<unsigned char>(4 * side * side);
};

}  // namespace

std::unique_ptr<HeadlessContext> make_headless_context() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace winslow::gui

#else

#define EGL_EGL_PROTOTYPES 0  // all calls go through Egl
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <mutex>
#include <string_view>

#include "core/error.h"

namespace winslow::gui {
namespace {

constexpr std::string_view hint =
    "; drawing without a display needs EGL and Mesa's drivers (Debian: apt-get install libegl1 "
    "libegl-mesa0 libgl1-mesa-dri)";

[[noreturn]] void fail(const std::string& what) { throw Error(what + std::string(hint)); }

bool has_extension(const char* list, std::string_view name) {
  return list != nullptr && std::string_view(list).find(name) != std::string_view::npos;
}

/// The functions of EGL that are needed. The library is loaded with the first picture, so that
/// everything that draws nothing works on machines without it.
struct Egl {
  PFNEGLBINDAPIPROC bind_api;
  PFNEGLCHOOSECONFIGPROC choose_config;
  PFNEGLCREATECONTEXTPROC create_context;
  PFNEGLDESTROYCONTEXTPROC destroy_context;
  PFNEGLGETCURRENTCONTEXTPROC get_current_context;
  PFNEGLGETCURRENTDISPLAYPROC get_current_display;
  PFNEGLGETCURRENTSURFACEPROC get_current_surface;
  PFNEGLGETDISPLAYPROC get_display;
  PFNEGLGETPROCADDRESSPROC get_proc_address;
  PFNEGLINITIALIZEPROC initialize;
  PFNEGLMAKECURRENTPROC make_current;
  PFNEGLQUERYSTRINGPROC query_string;
};

template <class Function>
void find_function(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  if (function == nullptr) fail(std::string("libEGL.so.1 has no ") + name);
}

Egl load_egl() {
  // Never closed: drivers leave threads and handlers behind.
  void* const library = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = ::dlerror();
    fail(why != nullptr ? why : "libEGL.so.1 cannot be loaded");
  }
  Egl egl;
  find_function(library, "eglBindAPI", egl.bind_api);
  find_function(library, "eglChooseConfig", egl.choose_config);
  find_function(library, "eglCreateContext", egl.create_context);
  find_function(library, "eglDestroyContext", egl.destroy_context);
  find_function(library, "eglGetCurrentContext", egl.get_current_context);
  find_function(library, "eglGetCurrentDisplay", egl.get_current_display);
  find_function(library, "eglGetCurrentSurface", egl.get_current_surface);
  find_function(library, "eglGetDisplay", egl.get_display);
  find_function(library, "eglGetProcAddress", egl.get_proc_address);
  find_function(library, "eglInitialize", egl.initialize);
  find_function(library, "eglMakeCurrent", egl.make_current);
  find_function(library, "eglQueryString", egl.query_string);
  return egl;
}

/// The functions of EGL. Throws Error if EGL cannot be loaded.
const Egl& egl() {
  static const Egl loaded = load_egl();
  return loaded;
}

/// The surfaceless platform needs no display; the default display is the fallback for drivers
/// without it.
EGLDisplay find_display() {
  const char* extensions = egl().query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (has_extension(extensions, "EGL_MESA_platform_surfaceless")) {
    const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        egl().get_proc_address("eglGetPlatformDisplayEXT"));
    if (get_platform_display != nullptr) {
      const EGLDisplay display = get_platform_display(
          EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
      if (display != EGL_NO_DISPLAY) return display;
    }
  }
  return egl().get_display(EGL_DEFAULT_DISPLAY);
}

/// Opens the display once per process: EGL gives every caller the same one. Mesa, if closed and
/// opened again, reloads its driver and leaks the memory of the previous one.
EGLDisplay open_display() {
  static std::mutex mutex;
  static EGLDisplay display = EGL_NO_DISPLAY;
  const std::lock_guard lock(mutex);
  if (display != EGL_NO_DISPLAY) return display;
  const EGLDisplay found = find_display();
  if (found == EGL_NO_DISPLAY) fail("no EGL display");
  if (egl().initialize(found, nullptr, nullptr) == EGL_FALSE) fail("EGL does not start");
  display = found;
  return display;
}

class EglContext : public HeadlessContext {
 public:
  EglContext()
      : previous_display_(egl().get_current_display()),
        previous_context_(egl().get_current_context()),
        previous_draw_(egl().get_current_surface(EGL_DRAW)),
        previous_read_(egl().get_current_surface(EGL_READ)) {
    if (!has_extension(egl().query_string(display_, EGL_EXTENSIONS),
                       "EGL_KHR_surfaceless_context")) {
      fail("EGL cannot draw without a surface");
    }
    if (egl().bind_api(EGL_OPENGL_API) == EGL_FALSE) fail("EGL offers no desktop OpenGL");
    const EGLConfig config = choose_config();
    constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               3,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               3,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
    context_ = egl().create_context(display_, config, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) fail("EGL has no OpenGL 3.3 core context");
    try {
      if (egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
        fail("EGL cannot make its context current");
      }
      load_gl(egl().get_proc_address);
    } catch (...) {
      release();
      throw;
    }
  }
  ~EglContext() override { release(); }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  std::string description() const override { return "EGL surfaceless, " + renderer_name(); }

 private:
  /// A context without surfaces needs no particular config. Drivers without the extension for that
  /// get the first config that can draw OpenGL.
  EGLConfig choose_config() const {
    constexpr std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                           EGL_PBUFFER_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (egl().choose_config(display_, wanted.data(), &config, 1, &found) == EGL_TRUE && found > 0) {
      return config;
    }
    return EGL_NO_CONFIG_KHR;
  }

  void release() {
    if (previous_context_ != EGL_NO_CONTEXT) {
      egl().make_current(previous_display_, previous_draw_, previous_read_, previous_context_);
    } else {
      egl().make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    egl().destroy_context(display_, context_);
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
