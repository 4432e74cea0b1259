#include <doctest/doctest.h>

#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

TEST_CASE("a motion in space that ends on the way stands in the history as far as it came") {
  Rig rig;
  rig.open(make_mesh(winslow::test::cube_with_cavity(6, winslow::test::Volumes::tetrahedra)));
  const Index cavity = rig.marker("cavity");
  rig.bench->apply(action::SelectMarkers{{cavity}});
  // Through the outer wall: it cannot come there.
  rig.bench->apply(action::ApplyMotion{SpaceMotion{0, {0, 0, 1}, {0.5, 0.5, 0.5}, {0.9, 0, 0}}});
  REQUIRE(rig.wait([&] { return !rig.session().job().active() && rig.bench->settled(); }));
  REQUIRE(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.document().history().position() == 1);
  const auto& move = std::get<MoveCommand>(rig.document().history().command(1));
  CHECK(move.motion.rotate == 0);
  CHECK(move.motion.translate.y() == 0);
  CHECK(move.motion.translate_z == 0);
  CHECK(move.motion.translate.x() < 0.9);
  CHECK(move.motion.translate.x() > 0);
  const Index node = rig.mesh().topology->markers().nodes(cavity).front();
  const Coordinates& rest = rig.document().history().state(0).mesh.coordinates;
  CHECK((rig.mesh().coordinates.xyz(node) - rest.xyz(node)).x() ==
        doctest::Approx(move.motion.translate.x()));
}

}  // namespace winslow::gui::test
