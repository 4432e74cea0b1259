#ifdef WINSLOW_HAS_OSMESA

#include "gui/render/gl.h"
// The loader's header stands in for GL/gl.h, which osmesa.h would include; these two macros are all
// that it takes from there besides the types.
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
#include "gui/render/gl_context.h"

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

  std::string description() const override {
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return std::string("OSMesa, ") + (renderer != nullptr ? renderer : "unknown renderer");
  }

 private:
  /// OSMesa cannot say what its current context draws into, so this class remembers.
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

#endif
