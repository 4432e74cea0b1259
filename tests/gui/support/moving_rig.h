#pragma once

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/command/command.h"
#include "core/motion/rigid_motion.h"
#include "gui/menu/user_command.h"
#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

/// A studio with a volume mesh, one marker of which is selected.
struct MovingStudio : Rig {
  /// A body of a fifth of the box around it.
  explicit MovingStudio(
      const Mesh& mesh = winslow::test::box_with_body(5, winslow::test::Volumes::tetrahedra),
      const std::string& name = "body")
      : Rig(1000, 760) {
    open(mesh);
    set_view(*this, [](ViewOptions& view) { view.left_panel = true; });
    take(name);
    key(GLFW_KEY_7);
    frames();
  }

  /// Selects a marker, as its row in the list does.
  void take(const std::string& name) {
    click("marker/" + name);
    REQUIRE(session().selection().markers() == std::vector<Index>{marker(name)});
  }
  const SpaceCamera& view() const { return bench->view_control().space().view(); }
  ScreenPoint at(const Vec3& point) const { return view().project(point).at; }
  /// A place of a handle of the gizmo, as the picture has it: "arrow/x".
  ScreenPoint handle(const std::string& id) const {
    const auto rect = bench->widgets().find("gizmo/" + id);
    INFO("handle ", id);
    REQUIRE(rect.has_value());
    return rect->centre();
  }
  /// The motion under the mouse.
  RigidMotion live() const { return session().mesh().live_motion().value(); }
  RigidMotion last_motion() const {
    const auto* move =
        std::get_if<MoveCommand>(&document().history().command(document().history().position()));
    REQUIRE(move != nullptr);
    return move->bodies.front().motion;
  }
  const DeformCommand& last_deform() const {
    return std::get<DeformCommand>(document().history().command(document().history().position()));
  }
  /// Waits until the mesh on screen is the solution for where the mouse is, or the limit.
  void follow() {
    REQUIRE(session().mesh().work().body_drag() != nullptr);
    REQUIRE(wait(
        [this] {
          const BodyDrag* drag = session().mesh().work().body_drag();
          return drag && drag->settled() && drag->reach() != BodyDrag::Reach::catching_up;
        },
        240));
  }
  /// The mesh of the history is what its last command makes of the one before, headless and at the
  /// tolerance of a drag.
  void check_replay() const {
    const auto& history = document().history();
    const std::size_t now = history.position();
    REQUIRE(now > 0);
    Command command = history.command(now);
    if (SmoothOptions* options = smooth_options(command)) {
      CHECK_FALSE(options->tolerance);  // the default is not pinned
      options->tolerance = 1e-10;
    }
    const CommandResult again = execute(command, history.state(now - 1));
    double apart = 0;
    for (Index i = 0; i < mesh().coordinates.size(); ++i)
      apart =
          std::max(apart, (again.state.mesh.coordinates.xyz(i) - mesh().coordinates.xyz(i)).norm());
    CHECK(apart < 1e-6);
  }
  /// Why a command cannot be done now.
  std::string blocked(std::string_view id) {
    ActionQueue actions;
    const PanelContext context{session(),
                               bench->view_control().options(),
                               bench->view_control().state(),
                               bench->theme(),
                               actions,
                               bench->capture(),
                               bench->recent(),
                               bench->demo(),
                               nullptr,
                               nullptr};
    return why_blocked(user_command(id), context);
  }
};

/// A place on the same circle about a centre, counter-clockwise on screen.
inline ScreenPoint around(const ScreenPoint& centre, const ScreenPoint& from, double degrees) {
  const ScreenVector arm = from - centre;
  const double a = -radians(degrees);
  return centre + ScreenVector(std::cos(a) * arm.x() - std::sin(a) * arm.y(),
                               std::sin(a) * arm.x() + std::cos(a) * arm.y());
}

/// Goes around a centre with the button down, counter-clockwise on screen, from where a drag was
/// begun.
inline void go_around(Rig& rig, const ScreenPoint& centre, const ScreenPoint& from, double degrees,
                      int steps) {
  for (int k = 1; k <= steps; ++k) rig.move(around(centre, from, degrees * k / steps));
}

/// How far a motion moves, in pixels of the view.
inline double pixels(const MovingStudio& studio, const Vec3& way) {
  return way.norm() / studio.view().pixel_size(studio.session().selection().space_pivot());
}

}  // namespace winslow::gui::test
