#include "gui/document/session/ongoing_work.h"

#include "gui/support/session_parts.h"

namespace winslow::gui::test {

TEST_CASE("nothing is under way at first") {
  const NothingOpen nothing;
  CHECK_FALSE(nothing.work.active());
  CHECK(nothing.work.coordinates() == nullptr);
  CHECK(nothing.work.topology() == nullptr);
  CHECK(nothing.work.base() == nullptr);
  CHECK(nothing.work.body_drag() == nullptr);
  CHECK(nothing.work.edited_vcvs() == nullptr);
}

TEST_CASE("of a job and a drag the drag is what is seen") {
  SessionParts parts(ring_mesh());
  REQUIRE(parts.jobs.start(ScrambleCommand{1}, true));
  CHECK(parts.work.active());
  CHECK(parts.work.coordinates() == &parts.work.job().coordinates());
  CHECK(*parts.work.topology() == parts.mesh.document()->topology());
  const MeshState& opened = parts.mesh.document()->state();
  parts.work.begin_drag(opened, DragGrip{{"flap"}, {}, {}}, {}, {});
  REQUIRE(parts.work.body_drag() != nullptr);
  CHECK(parts.work.coordinates() == &parts.work.body_drag()->coordinates());
  CHECK(parts.work.base()->mesh.coordinates == opened.mesh.coordinates);
  parts.jobs.stop();
  CHECK_FALSE(parts.work.active());
}

TEST_CASE("VCVs are edited ones only while a job edits them") {
  SessionParts parts(ring_mesh());
  parts.work.set_edited_vcvs({parts.mesh.vcv(), {}});
  CHECK(parts.work.edited_vcvs() == nullptr);
  REQUIRE(parts.jobs.start(ScrambleCommand{1}, true));
  CHECK(parts.work.edited_vcvs() == nullptr);
  parts.jobs.stop();
}

}  // namespace winslow::gui::test
