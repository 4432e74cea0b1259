#include "gui/document/session/quality_watch.h"

#include "gui/support/session_parts.h"

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
  const LiveMesh mesh;
  QualityWatch watch(mesh);
  watch.watch(std::nullopt);
  watch.measure_now(std::nullopt);
  CHECK_FALSE(watch.busy());
  CHECK(watch.latest() == nullptr);
}

}  // namespace winslow::gui::test
