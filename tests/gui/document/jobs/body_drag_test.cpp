#include "gui/document/jobs/body_drag.h"

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "core/error.h"
#include "support/surface_meshes.h"

namespace winslow::gui::test {
namespace {

bool wait_until(const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// A cavity in a cube is dragged, whose outside slides on a file that is read when the test says
/// so.
struct DragOnFile {
  DragOnFile()
      : state(make_state(
            make_mesh(winslow::test::cube_with_cavity(6, winslow::test::Volumes::tetrahedra)))) {
    SmoothOptions options;
    options.slide.markers = {"outer"};
    options.slide.reference = "box.obj";
    drag.begin(state, DragGrip{{"cavity"}, {}, {}}, options, {},
               [read = file.get_future().share()](const SlideOptions& slide) {
                 CHECK(slide.reference == "box.obj");
                 return read.get();
               });
    CHECK(drag.active());
    CHECK(drag.reach() == BodyDrag::Reach::there);
    RigidMotion motion;
    motion.translate = Vec3(0.02, 0, 0);
    drag.to(motion);
  }

  MeshState state;
  BodyDrag drag;
  std::promise<SlideFiles> file;
};

}  // namespace

TEST_CASE("a drag shows the mesh as it is while its reference surface is read, then follows") {
  DragOnFile made;
  BodyDrag& drag = made.drag;
  CHECK_FALSE(drag.poll());
  CHECK(drag.reach() == BodyDrag::Reach::catching_up);
  CHECK_FALSE(drag.settled());
  CHECK(drag.error().empty());
  CHECK(drag.coordinates() == made.state.mesh.coordinates);
  auto box = std::make_shared<ReferenceSurface>();
  const MeshData data =
      winslow::test::skin(winslow::test::cube(4, winslow::test::Volumes::hexahedra));
  for (Index i = 0; i < data.node_count(); ++i) box->points.push_back(data.coordinates.xyz(i));
  for (Index e = 0; e < data.element_count(); ++e) box->faces.emplace_back(data.element(e));
  made.file.set_value({.reference = box});
  REQUIRE(wait_until([&] {
    drag.poll();
    return drag.settled() || !drag.error().empty();
  }));
  CHECK(drag.error() == "");
  drag.poll();
  CHECK(drag.reach() == BodyDrag::Reach::there);
  CHECK(drag.coordinates() != made.state.mesh.coordinates);
}

TEST_CASE("a drag whose reference surface cannot be read says why and stays") {
  DragOnFile made;
  BodyDrag& drag = made.drag;
  made.file.set_exception(std::make_exception_ptr(InputError("box.obj:3: found \"v\"")));
  REQUIRE(wait_until([&] { return drag.poll(); }));
  CHECK(drag.error() == "box.obj:3: found \"v\"");
  CHECK(drag.reach() == BodyDrag::Reach::limit);
  CHECK_FALSE(drag.settled());
  CHECK(drag.coordinates() == made.state.mesh.coordinates);
  drag.end();
  CHECK_FALSE(drag.active());
}

TEST_CASE("a drag ends while its reference surface is read") {
  DragOnFile made;
  made.drag.end();
  CHECK_FALSE(made.drag.active());
  CHECK_FALSE(made.drag.poll());
  made.file.set_value({});
}

}  // namespace winslow::gui::test
