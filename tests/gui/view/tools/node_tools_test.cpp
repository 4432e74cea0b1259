#include <doctest/doctest.h>

#include <cmath>

#include "core/error.h"
#include "gui/picture/picture.h"
#include "gui/support/meshes.h"
#include "gui/view/tools/plane_picker.h"
#include "gui/view/tools/vcv_drag.h"
#include "support/random.h"

namespace winslow::gui::test {

namespace {

NodalView view_in(const Mesh& mesh, Index node) {
  return inspect_node(VirtualControlVolumes(mesh.topology), mesh.coordinates, node);
}

Vec2 at_angle(double length, double angle) {
  return length * Vec2(std::cos(radians(angle)), std::sin(radians(angle)));
}

}  // namespace

TEST_CASE("the node index finds the same node as a look at all of them") {
  const Mesh mesh = ring_mesh(40, 12);
  const NodeIndex index(*mesh.topology, mesh.coordinates);
  NodePicker behind;
  constexpr std::uint64_t seed = 21;
  CAPTURE(seed);
  winslow::test::Random random(seed);
  int found = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Vec2 p(random.uniform(-3.5, 3.5), random.uniform(-3.5, 3.5));
    const double radius = random.uniform(0, 0.4);
    const auto near = index.nearest(p, radius);
    CHECK(near == behind.pick(1, *mesh.topology, mesh.coordinates, p, radius));
    if (near) CHECK((mesh.coordinates.xy(*near) - p).norm() <= radius);
    found += near ? 1 : 0;
  }
  CHECK(found > 100);
}

TEST_CASE("a drag of a VCV's edge turns and pulls it, within limits; the other edges stay") {
  const Mesh mesh = ring_mesh();
  const NodalView view = view_in(mesh, mesh.topology->interior_nodes()[40]);
  REQUIRE(view.neighbours.size() == 6);
  using Constraint = VcvDrag::Constraint;
  for (std::size_t edge = 0; edge < 6; ++edge) {
    CAPTURE(edge);
    const VcvDrag drag(view, edge);
    const double direction = 60.0 * static_cast<double>(edge);
    const VcvEdit moved = drag.to(at_angle(1.5, direction + 20), Constraint::none, 3);
    CHECK(moved.angles[(edge + 5) % 6] == doctest::Approx(80));
    CHECK(moved.angles[edge] == doctest::Approx(40));
    CHECK(moved.lengths[edge] == doctest::Approx(1.5));
    CHECK(moved.lengths[(edge + 1) % 6] == 1);
    // The picture is turned by what keeps the other edges where they were.
    CHECK(drag.turn(moved) == doctest::Approx(edge == 0 ? radians(20) : 0));
    const VcvEdit far = drag.to(at_angle(9, direction + 170), Constraint::none, 3);
    CHECK(far.angles[edge] == doctest::Approx(5));
    CHECK(far.lengths[edge] == doctest::Approx(3));
    const VcvEdit back = drag.to(at_angle(0.01, direction - 170), Constraint::none, 3);
    CHECK(back.angles[(edge + 5) % 6] == doctest::Approx(5));
    CHECK(back.lengths[edge] == doctest::Approx(0.1));
    CHECK(drag.to(at_angle(2, direction + 9), Constraint::angle_only, 3).lengths[edge] == 1);
    CHECK(drag.to(at_angle(2, direction + 9), Constraint::length_only, 3).angles[edge] ==
          doctest::Approx(60));
  }
}

TEST_CASE("a picture shows the VCVs asked for, and refuses a node that has none") {
  const Mesh mesh = ring_mesh();
  PictureOptions options;
  options.width = 300;
  options.height = 240;
  const Image plain = draw_picture(mesh, options);
  options.vcvs = {mesh.topology->interior_nodes()[40]};
  const Image one = draw_picture(mesh, options);
  CHECK(plain.rgba != one.rgba);
  options.vcvs = {0};
  CHECK_THROWS_AS(draw_picture(mesh, options), UsageError);
  options.vcvs = {mesh.topology->node_count()};
  CHECK_THROWS_AS(draw_picture(mesh, options), UsageError);
}

}  // namespace winslow::gui::test
