#include "gui/document/session/quality_watch.h"

#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "gui/support/session_parts.h"
#include "support/meshes.h"

namespace winslow::gui::test {

TEST_CASE("what is measured is the mesh on screen, by the field asked for") {
  SessionParts parts(tangled_mesh());
  QualityWatch watch(parts.mesh);
  CHECK(watch.latest() == nullptr);
  watch.measure_now(ElementField(Metric::aspect_ratio));
  REQUIRE(watch.latest() != nullptr);
  CHECK(watch.latest()->shape == parts.mesh.shape());
  CHECK(watch.latest()->report.inverted > 0);
  CHECK(watch.latest()->field == ElementField(Metric::aspect_ratio));
  CHECK(watch.latest()->values.size() ==
        static_cast<std::size_t>(parts.mesh.topology()->element_count()));
  watch.clear();
  CHECK(watch.latest() == nullptr);
}

TEST_CASE("without a mesh nothing is measured") {
  const NothingOpen nothing;
  const LiveMesh& mesh = nothing.mesh;
  QualityWatch watch(mesh);
  watch.watch(std::nullopt);
  watch.measure_now(std::nullopt);
  CHECK_FALSE(watch.busy());
  CHECK(watch.latest() == nullptr);
}

TEST_CASE("a mesh may be forgotten as soon as the quality beside it has been asked for") {
  using winslow::test::Cells;
  const auto mesh =
      std::make_shared<const Mesh>(make_mesh(winslow::test::square(20, Cells::triangles)));
  const auto vcv = std::make_shared<const VirtualControlVolumes>(mesh->topology);
  QualityMonitor monitor;
  for (std::uint64_t shape = 1; shape <= 20; ++shape) {
    auto before = std::make_unique<Coordinates>(mesh->coordinates);
    const void* numbers = before->values().data();
    monitor.request(shape, {mesh, vcv, nullptr, nullptr},
                    {.field = Metric::normalized_jacobian, .before = before.get()}, false);
    before.reset();  // as the history drops a state
    while (!monitor.poll()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    REQUIRE(monitor.latest());
    CHECK(monitor.latest()->shape == shape);
    CHECK(monitor.latest()->before == numbers);
  }
}

}  // namespace winslow::gui::test
