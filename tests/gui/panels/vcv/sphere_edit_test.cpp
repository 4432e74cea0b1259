#include <doctest/doctest.h>

#include <cmath>

#include "gui/support/pixels.h"
#include "gui/support/vcv_rig.h"

namespace winslow::gui::test {

namespace {

bool all_valid(const Rig& rig) {
  return check_validity(*rig.mesh().topology, rig.session().coordinates()).inverted == 0;
}

double furthest_shift(const Coordinates& a, const Coordinates& b) {
  double most = 0;
  for (Index i = 0; i < a.size(); ++i) most = std::max(most, (a.xyz(i) - b.xyz(i)).norm());
  return most;
}

}  // namespace

TEST_CASE("sphere edit: dragging a point moves the mesh while held, one step of history, undone") {
  SphereStudio studio;
  studio.bench->apply(action::RunSmooth{});
  REQUIRE(studio.settle());
  const Index node = studio.inner();
  studio.inspect(node);
  const Coordinates before = studio.session().coordinates();
  const std::size_t steps = studio.document().history().size();
  studio.drag_point(studio.nearest_point(node), ScreenVector(14, 8));
  REQUIRE(studio.session().job().active());
  CHECK(studio.wait([&] { return furthest_shift(before, studio.session().coordinates()) > 1e-4; }));
  CHECK(studio.document().history().size() == steps);
  CHECK(studio.view(node).edited);
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().size() == steps + 1);
  CHECK(all_valid(studio));
  const auto& command = std::get<EditVcvCommand>(studio.document().history().command(steps));
  REQUIRE(command.edits.size() == 1);
  CHECK(command.edits[0].node == node);
  CHECK(command.edits[0].directions.size() == studio.view(node).neighbours.size());
  CHECK(studio.document().history().result(steps).converged);
  studio.bench->apply(action::Undo{});
  CHECK(studio.mesh().coordinates == before);
  studio.frames(2);
  CHECK_FALSE(studio.view(node).edited);
}

TEST_CASE("sphere edit: a drag turns one direction and no length; with Ctrl it is the other way") {
  SphereStudio studio;
  const Index node = studio.inner();
  studio.inspect(node);
  for (const bool control : {false, true}) {
    CAPTURE(control);
    const VolumeNodalView start = studio.view(node);
    const std::size_t k = studio.nearest_point(node);
    const std::size_t steps = studio.document().history().position();
    if (control) studio.input.key(keys::control, true);
    studio.drag_point(k, ScreenVector(9, -7));
    studio.release();
    if (control) studio.input.key(keys::control, false);
    REQUIRE(studio.settle());
    REQUIRE(studio.document().history().position() == steps + 1);
    const VcvEdit edit =
        std::get<EditVcvCommand>(studio.document().history().command(steps + 1)).edits[0];
    for (std::size_t i = 0; i < edit.directions.size(); ++i) {
      const double turned = (edit.directions[i] - start.vcv.points[i].normalized()).norm();
      const double pulled = std::abs(edit.lengths[i] - start.vcv.lengths[i]);
      CHECK((turned > 0.01) == (i == k && !control));
      CHECK((pulled > 0.01) == (i == k && control));
    }
    studio.bench->apply(action::Undo{});
    studio.frames(3);
  }
}

TEST_CASE(
    "sphere edit: a face about to turn over stops the point, which is said, and stays valid") {
  SphereStudio studio;
  const Index node = studio.inner();
  studio.inspect(node);
  const std::size_t k = studio.nearest_point(node);
  const WidgetMap::Rect plot = studio.rect("vcv/plot");
  const ScreenPoint from = studio.middle("vcv/end/" + std::to_string(k));
  studio.drag(from, ScreenPoint(plot.max.x() - 3, plot.min.y() + 3), 8);
  CHECK(studio.visible("vcv/stopped"));
  REQUIRE(studio.session().job().active());
  const VolumeNodalView& now = studio.view(node);
  CHECK(*std::ranges::min_element(now.vcv.solid_angles) > 0);
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.session().messages().prompt() == nullptr);  // nothing was refused
  CHECK_FALSE(studio.visible("vcv/stopped"));
  CHECK(all_valid(studio));
  CHECK(studio.view(node).edited);
}

TEST_CASE("sphere edit: Esc ends a drag and puts the mesh back") {
  SphereStudio studio;
  const Index node = studio.inner();
  studio.inspect(node);
  const Coordinates before = studio.session().coordinates();
  const std::size_t steps = studio.document().history().size();
  studio.drag_point(studio.nearest_point(node), ScreenVector(-12, 9));
  REQUIRE(studio.session().job().active());
  studio.key(keys::escape);
  CHECK_FALSE(studio.session().job().active());
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.session().coordinates() == before);
  CHECK(studio.document().history().size() == steps);
  CHECK_FALSE(studio.view(node).edited);
}

TEST_CASE("sphere edit: a typed length and a typed direction; what is no VCV is refused and said") {
  SphereStudio studio(1300, 1300);
  const Index node = studio.inner();
  studio.inspect(node);
  studio.click("vcv/row/1");
  studio.fill("vcv/length", "2.5");
  studio.key(keys::enter);
  REQUIRE(studio.settle());
  studio.frames(2);
  CHECK(studio.view(node).vcv.lengths[1] == doctest::Approx(2.5));
  CHECK(studio.view(node).edited);
  const std::size_t steps = studio.document().history().size();
  // Where the opposite neighbour lies there is no place.
  const VolumeNodalView& view = studio.view(node);
  const Vec3 away = -view.vcv.points[1].normalized();
  const Vec3 now = view.vcv.points[1].normalized();
  for (const auto& [axis, value] :
       {std::pair("vcv/direction_x", away.x()), std::pair("vcv/direction_y", away.y()),
        std::pair("vcv/direction_z", away.z())})
    studio.fill(axis, std::to_string(value));
  studio.key(keys::enter);
  REQUIRE(studio.settle());
  CHECK(studio.document().history().size() == steps);
  const auto* prompt = studio.session().messages().prompt();
  CHECK((prompt != nullptr || studio.session().messages().notice().has_value()));
  CHECK((studio.view(node).vcv.points[1].normalized() - now).norm() < 1e-9);
}

TEST_CASE("sphere edit: Reset gives a node its own VCV again, Reset all all of them") {
  SphereStudio studio(1300, 1300);
  const auto interior = studio.mesh().topology->interior_nodes();
  for (const Index node : {interior[5], studio.inner()}) {
    studio.inspect(node);
    studio.drag_point(studio.nearest_point(node), ScreenVector(8, 5));
    studio.release();
    REQUIRE(studio.settle());
    studio.frames(3);
  }
  REQUIRE(studio.session().mesh().sphere_vcvs());
  CHECK(studio.session().mesh().sphere_vcvs()->size() == 2);
  studio.click("vcv/reset");
  REQUIRE(studio.settle());
  studio.frames(2);
  REQUIRE(studio.session().mesh().sphere_vcvs());
  CHECK(studio.session().mesh().sphere_vcvs()->size() == 1);
  CHECK_FALSE(studio.view(studio.inner()).edited);
  studio.click("vcv/reset_all");
  REQUIRE(studio.settle());
  CHECK(studio.session().mesh().sphere_vcvs() == nullptr);
}

TEST_CASE("sphere pins: a pinned VCV is drawn over the mesh at its node, as large as its star") {
  SphereStudio studio;
  const Index node = studio.inner();
  studio.inspect(node);
  studio.move(ScreenPoint(5, 995));
  studio.frames(3);
  const Image plain = studio.bench->pictures().picture();
  const SpaceCamera& seen = studio.bench->view_control().space().view();
  const Vec3 place = studio.mesh().coordinates.xyz(node);
  const ScreenPoint at = seen.project(place).at;
  const double reach = studio.view(node).physical.mean_length() / seen.pixel_size(place);
  const ScreenVector box(reach, reach), beyond(2.5 * reach, 2.5 * reach);
  studio.click("vcv/pin");
  studio.move(ScreenPoint(5, 995));
  studio.frames(2);
  CHECK(studio.session().nodes().pinned() == std::vector<Index>{node});
  CHECK(studio.visible("pin/" + std::to_string(node)));
  const Image pinned = studio.bench->pictures().picture();
  const int inside = differing(plain, pinned, at - box, at + box);
  CHECK(inside > 1.5 * reach * reach);
  CHECK(differing(plain, pinned, at - beyond, at + beyond) < 1.6 * inside);
  studio.click("vcv/clear_pins");
  studio.move(ScreenPoint(5, 995));
  studio.frames(2);
  CHECK(studio.session().nodes().pinned().empty());
  CHECK(differing(plain, studio.bench->pictures().picture(), at - box, at + box) == 0);
}

TEST_CASE("sphere pins: they are in pictures of the mesh, too, and follow an edit") {
  SphereStudio studio;
  const Index node = studio.inner();
  studio.bench->apply(action::PinNodes{{node}, true});
  studio.bench->apply(action::PinNodes{{0}, true});  // a corner: it has none
  studio.frames(2);
  CHECK(studio.session().nodes().pinned() == std::vector<Index>{node});
  const auto picture = [&] { return studio.bench->pictures().picture(); };
  const Image with = picture();
  studio.inspect(node);
  studio.move(ScreenPoint(5, 995));
  studio.frames(2);
  const Image before = picture();
  studio.drag_point(studio.nearest_point(node), ScreenVector(16, 10));
  studio.release();
  REQUIRE(studio.settle());
  studio.move(ScreenPoint(5, 995));
  studio.frames(2);
  const SpaceCamera& seen = studio.bench->view_control().space().view();
  const ScreenPoint at = seen.project(studio.mesh().coordinates.xyz(node)).at;
  const ScreenVector box(40, 40);
  CHECK(differing(before, picture(), at - box, at + box) > 50);
}

namespace {

void choose_nodes(Rig& rig, const std::string& nodes) {
  rig.click("vcv/spread");
  rig.frames(3);
  rig.click("vcv/spread/" + nodes);
  REQUIRE(rig.settle());
  rig.frames(2);
}

/// Gives a node a control volume of its own by a typed length.
void edit(SphereStudio& studio, Index node) {
  studio.inspect(node);
  studio.fill("vcv/length", "1.7");
  REQUIRE(studio.settle());
  REQUIRE(studio.view(node).edited);
  studio.frames(2);
}

std::size_t edited_count(const SphereStudio& studio) {
  const auto stencils = studio.session().mesh().sphere_vcvs();
  return stencils ? stencils->size() : 0;
}

bool can_apply(const SphereStudio& studio) {
  return studio.bench->widgets().find("vcv/apply")->enabled;
}

}  // namespace

TEST_CASE("a control volume on the sphere goes to all nodes with the same link, in one step") {
  SphereStudio studio(1300, 1200);
  const Index node = studio.inner();
  edit(studio, node);
  const std::size_t steps = studio.document().history().size();
  const std::size_t inner = studio.mesh().topology->interior_nodes().size();
  choose_nodes(studio, "All nodes");
  REQUIRE(can_apply(studio));
  studio.click("vcv/apply");
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().size() == steps + 1);
  CHECK(edited_count(studio) == inner);
  // The same weights wherever it went: they do not see how it is turned, but which edge is which.
  const VolumeNodalView own = studio.view(node);
  for (const Index other : studio.mesh().topology->interior_nodes()) {
    const auto& lengths = studio.view(other).vcv.lengths;
    CHECK(std::ranges::max(lengths) / std::ranges::min(lengths) ==
          doctest::Approx(std::ranges::max(own.vcv.lengths) / std::ranges::min(own.vcv.lengths)));
  }
  CHECK(check_validity(*studio.mesh().topology, studio.mesh().coordinates).inverted == 0);
  studio.key(keys::z, {keys::control});
  REQUIRE(studio.settle());
  CHECK(edited_count(studio) == 1);
}

TEST_CASE("a control volume on the sphere goes to pinned nodes and within a radius, no further") {
  SphereStudio studio(1300, 1200);
  const Index node = studio.inner();
  edit(studio, node);
  // None is pinned, and the button says what to do.
  choose_nodes(studio, "Pinned nodes");
  CHECK_FALSE(can_apply(studio));
  const Index pinned = studio.mesh().topology->interior_nodes()[2];
  studio.bench->apply(action::PinNodes{{pinned}});
  REQUIRE(studio.settle());
  studio.frames(2);
  REQUIRE(can_apply(studio));
  studio.click("vcv/apply");
  REQUIRE(studio.settle());
  CHECK(edited_count(studio) == 2);
  CHECK(studio.view(pinned).edited);

  choose_nodes(studio, "Nodes within a radius");
  studio.fill("vcv/radius", "1e-9");
  REQUIRE(studio.settle());
  studio.frames(2);
  CHECK_FALSE(can_apply(studio));
  const double radius = 1.3 * studio.view(node).physical.mean_length();
  studio.fill("vcv/radius", std::to_string(radius));
  REQUIRE(studio.settle());
  studio.frames(2);
  REQUIRE(can_apply(studio));
  const Coordinates x = studio.mesh().coordinates;
  studio.click("vcv/apply");
  REQUIRE(studio.settle());
  int within = 0;
  for (const Index other : studio.mesh().topology->interior_nodes()) {
    const bool near = (x.xyz(other) - x.xyz(node)).norm() <= radius;
    within += near;
    CHECK(studio.view(other).edited == (near || other == pinned));
  }
  CHECK(within > 3);
}

}  // namespace winslow::gui::test
