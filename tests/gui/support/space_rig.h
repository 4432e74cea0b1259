#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gui/menu/user_command.h"
#include "gui/support/rig.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"

namespace winslow::gui::test {

/// A studio that shows a mesh in space.
struct SpaceRig : Rig {
  using Rig::Rig;

  const SpaceControl& space() const { return bench->view_control().space(); }
  const ViewOptions& options() const { return bench->view_control().options(); }
  const ViewState& state() const { return bench->view_control().state(); }
  const VolumeView& picture() const { return bench->pane().mesh_view().volume(); }
  const VolumeScenes& scenes() const { return *picture().scenes(); }
  ScreenPoint at(const Vec3& point) const { return space().view().project(point).at; }
  /// Why a command cannot be given now; empty: it can.
  std::string blocked(std::string_view id) {
    ActionQueue actions;
    const PanelContext context{session(), options(),        state(),         bench->theme(),
                               actions,   bench->capture(), bench->recent(), bench->demo(),
                               nullptr,   nullptr};
    return why_blocked(user_command(id), context);
  }
};

/// A studio with a volume mesh, at first the unit cube with a cubic hole from 1/3 to 2/3, seen from
/// aslant and cut.
struct LookingRig : Rig {
  explicit LookingRig(const std::filesystem::path& profile = {}, int width = 1100, int height = 700)
      : Rig(width, height, profile) {
    open(cavity());
  }
  static Mesh cavity(winslow::test::Volumes volumes = winslow::test::Volumes::tetrahedra) {
    return make_mesh(winslow::test::cube_with_cavity(6, volumes));
  }

  const SpaceControl& space() const { return bench->view_control().space(); }
  const ViewOptions& options() const { return bench->view_control().options(); }
  const ViewState& state() const { return bench->view_control().state(); }
  const VolumeView& volume() const { return bench->pane().mesh_view().volume(); }
  const VolumeScenes& scenes() const { return *volume().scenes(); }
  ScreenPoint at(const Vec3& point) const { return space().view().project(point).at; }
  ScreenPoint middle() const { return space().view().viewport().centre(); }
  std::string blocked(std::string_view id) {
    ActionQueue actions;
    const PanelContext context{session(), options(),        state(),         bench->theme(),
                               actions,   bench->capture(), bench->recent(), bench->demo(),
                               nullptr,   nullptr};
    return why_blocked(user_command(id), context);
  }
  /// The node at a place, which there must be.
  Index node_at(const Vec3& place) const {
    const Coordinates& x = mesh().coordinates;
    for (Index i = 0; i < x.size(); ++i)
      if ((x.xyz(i) - place).norm() < 1e-9) return i;
    return -1;
  }
  /// Without cuts, so that the outside is seen as a surface.
  void show_outside() {
    set_view(*this, [](ViewOptions& view) {
      view.space.cuts.clear();
      MarkerLook look;
      look.drawing = MarkerDrawing::surface;
      view.markers.set("outer", look);
    });
  }
  /// Turns the hole by degrees about z, and waits for the mesh.
  void turn_cavity(double degrees) {
    bench->apply(action::SelectMarkers{{marker("cavity")}});
    frames();
    click("motion/rotate");
    key(keys::a, {keys::control});
    type(std::to_string(degrees));
    key(keys::enter);
    settle();
  }
};

/// A studio with a surface mesh, at first a ball of 288 triangles.
struct SurfaceRig : SpaceRig {
  explicit SurfaceRig(const Mesh& surface = ball(), int width = 1400, int height = 1300)
      : SpaceRig(width, height) {
    open(surface, "surface.obj");
  }
  static Mesh ball() { return make_mesh(winslow::test::octasphere(6)); }
  /// The surface of a cube of n by n by n cells.
  static Mesh box(Index n = 4) {
    using winslow::test::Volumes;
    return make_mesh(winslow::test::skin(winslow::test::cube(n, Volumes::hexahedra)));
  }
  /// Open, with one border.
  static Mesh saddle() {
    using winslow::test::Cells;
    return make_mesh(winslow::test::lifted(
        winslow::test::square(8, Cells::triangles),
        [](const Vec2& p) { return Vec3(p.x(), p.y(), (p.x() - 0.5) * (p.y() - 0.5)); }));
  }

  Validity shown() const { return scenes().shown.validity; }
  void scramble() {
    click("menu/Edit");
    click("menu/scramble");
    settle();
  }
  void color_by(std::string_view label) {
    click("tab/view");
    frames();
    click("view/color");
    click("view/color/" + std::string(label));
    click("tab/quality");
    settle();
  }
  /// The node that lies nearest to the viewer.
  Index nearest_node() const {
    const Coordinates& x = session().coordinates();
    Index best = 0;
    for (Index i = 1; i < x.size(); ++i)
      if (space().view().project(x.xyz(i)).depth < space().view().project(x.xyz(best)).depth)
        best = i;
    return best;
  }
};

}  // namespace winslow::gui::test
