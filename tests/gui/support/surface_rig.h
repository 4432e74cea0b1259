#pragma once

#include <string>
#include <string_view>

#include "gui/support/space_rig.h"
#include "support/surface_meshes.h"

namespace winslow::gui::test {

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
