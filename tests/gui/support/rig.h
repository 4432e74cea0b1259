#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "gui/document/actions/actions.h"
#include "gui/render/gl.h"
#include "gui/shell/workbench/workbench.h"
#include "gui/support/meshes.h"

namespace winslow::gui::test {

/// A studio without a window, worked by a script through the same queue that a window's events go
/// through.
class Rig {
 public:
  /// profile: folder of the studio's settings; empty: it keeps nothing.
  explicit Rig(int width = 1280, int height = 720, const std::filesystem::path& profile = {});

  /// Runs frames until all input is taken, then `more` of them.
  void frames(int more = 2);
  /// Runs frames until `done` holds. False after `seconds`.
  bool wait(const std::function<bool()>& done, double seconds = 600);
  /// Until nothing is under way.
  bool settle();

  /// Another size of the window, in pixels, from the next frame on.
  void resize(int width, int height) {
    width_ = width;
    height_ = height;
  }

  /// Opens a mesh and waits for it.
  void open(const Mesh& mesh, const std::string& name = "mesh.su2");

  void move(const ScreenPoint& to);
  void press(MouseButton button = MouseButton::left);
  void release(MouseButton button = MouseButton::left);
  void click(const ScreenPoint& at);
  /// Clicks a widget. Fails the test if it is not on screen.
  void click(const std::string& widget);
  /// Presses, goes there in steps, and stays down.
  void drag(const ScreenPoint& from, const ScreenPoint& to, int steps = 6,
            MouseButton button = MouseButton::left);
  void wheel(const ScreenPoint& at, double notches);
  void key(int glfw_key, std::vector<int> modifiers = {});
  void type(const std::string& text);
  /// Types into a field in place of what is there.
  void fill(const std::string& widget, const std::string& text);

  bool visible(const std::string& widget) const {
    return bench->widgets().find(widget).has_value();
  }
  const Session& session() const { return bench->session(); }
  const Document& document() const { return *session().document(); }
  const Mesh& mesh() const { return document().state().mesh; }
  Index marker(const std::string& name) const { return *mesh().topology->markers().find(name); }
  /// Pixel of a point of the mesh.
  ScreenPoint pixel(const Vec2& world) const {
    return bench->view_control().camera().to_screen(world);
  }
  /// What the mouse acts upon now.
  ViewportScene scene() const {
    return bench->pane().scene(static_cast<double>(bench->theme().scale));
  }
  /// The gizmo of the selection, which there must be.
  Gizmo gizmo() const { return mover().gizmo(scene(), bench->view_control().view()).value(); }
  const Mover& mover() const { return bench->pane().viewport().mover(); }

  TemporaryFolder folder;
  std::unique_ptr<HeadlessContext> context;
  std::unique_ptr<Workbench> bench;
  InputQueue input;

 private:
  void frame();

  int width_, height_;
};

/// They do not overlap on screen.
inline bool apart(const WidgetMap::Rect& a, const WidgetMap::Rect& b) {
  return a.min.x() >= b.max.x() || a.min.y() >= b.max.y() || b.min.x() >= a.max.x() ||
         b.min.y() >= a.max.y();
}

/// Turns the flap about the origin by degrees, shifts it, and waits for the mesh.
void turn_flap(Rig& rig, double degrees, const Vec2& by = Vec2(0, 0));

/// Changes how the mesh is shown, and waits until it is.
void set_view(Rig& rig, const std::function<void(ViewOptions&)>& change);

}  // namespace winslow::gui::test

/// Keys that scripts press.
namespace winslow::gui::test::keys {

inline constexpr int control = GLFW_KEY_LEFT_CONTROL;
inline constexpr int alt = GLFW_KEY_LEFT_ALT;
inline constexpr int shift = GLFW_KEY_LEFT_SHIFT;
inline constexpr int escape = GLFW_KEY_ESCAPE;
inline constexpr int space = GLFW_KEY_SPACE;
inline constexpr int tab = GLFW_KEY_TAB;
inline constexpr int enter = GLFW_KEY_ENTER;
inline constexpr int f12 = GLFW_KEY_F12;
inline constexpr int f1 = GLFW_KEY_F1;
inline constexpr int f2 = GLFW_KEY_F2;
inline constexpr int a = GLFW_KEY_A;
inline constexpr int e = GLFW_KEY_E;
inline constexpr int f = GLFW_KEY_F;
inline constexpr int n = GLFW_KEY_N;
inline constexpr int o = GLFW_KEY_O;
inline constexpr int p = GLFW_KEY_P;
inline constexpr int q = GLFW_KEY_Q;
inline constexpr int r = GLFW_KEY_R;
inline constexpr int s = GLFW_KEY_S;
inline constexpr int w = GLFW_KEY_W;
inline constexpr int z = GLFW_KEY_Z;

}  // namespace winslow::gui::test::keys

namespace winslow::gui::test {

/// Number of the last outer iteration on screen; -1 before the first.
inline int iterations(const Rig& rig) {
  const auto history = rig.session().mesh().convergence();
  return history.empty() ? -1 : history.back().iteration;
}

/// The solver has stopped between two iterations.
inline bool solver_paused(const Rig& rig) {
  const auto& snapshot = rig.session().job().snapshot();
  return snapshot && snapshot->state == JobState::paused;
}

/// The action is an A, in whichever of the groups that are variants themselves.
template <class A, class T>
bool holds(const T&) {
  return std::is_same_v<A, T>;
}
template <class A, class... As>
bool holds(const std::variant<As...>& action) {
  return std::visit([](const auto& a) { return holds<A>(a); }, action);
}

}  // namespace winslow::gui::test
