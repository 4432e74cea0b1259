#include "gui/document/session/vcv_editor.h"

#include "gui/support/session_parts.h"

namespace winslow::gui::test {

namespace {

VcvEdit long_edge(const SessionParts& parts, double length) {
  const Index node = parts.free_node();
  std::vector<double> lengths(parts.mesh.topology()->neighbours(node).size(), 1);
  lengths[0] = length;
  return {node, {}, {}, lengths};
}

}  // namespace

TEST_CASE("an edit is shown at once and stands in the history when the mesh is smoothed") {
  SessionParts parts(ring_mesh());
  const auto before = parts.mesh.vcv();
  parts.vcvs.apply(action::EditVcvs{{long_edge(parts, 2)}});
  CHECK(parts.mesh.vcv() != before);
  parts.finish();
  REQUIRE(parts.done().position() == 1);
  CHECK(std::holds_alternative<EditVcvCommand>(parts.done().command(1)));
}

TEST_CASE("under the mouse the last edit counts; cancelled, none does") {
  SessionParts parts(ring_mesh());
  const auto before = parts.mesh.vcv();
  parts.vcvs.apply(action::EditVcvs{{long_edge(parts, 2)}, true});
  CHECK(parts.work.held().vcv);
  CHECK(parts.work.job().held());
  SUBCASE("let go") {
    parts.vcvs.apply(action::EditVcvs{{long_edge(parts, 3)}, true});
    parts.vcvs.apply(action::EndVcvEdit{});
    parts.finish();
    REQUIRE(parts.done().size() == 2);
    const auto& command = std::get<EditVcvCommand>(parts.done().command(1));
    REQUIRE(command.edits.size() == 1);
    CHECK(command.edits[0].lengths[0] == 3);
  }
  SUBCASE("cancelled") {
    parts.vcvs.apply(action::CancelVcvEdit{});
    CHECK_FALSE(parts.mesh.in_motion());
    CHECK(parts.done().size() == 1);
    CHECK(parts.mesh.vcv() == before);
    CHECK(parts.notice() == "Edit cancelled");
  }
  CHECK_FALSE(parts.work.held().vcv);
}

TEST_CASE("numbers that are no VCV are said, and nothing begins") {
  SessionParts parts(ring_mesh());
  parts.vcvs.apply(action::EditVcvs{{long_edge(parts, -1)}});
  CHECK_FALSE(parts.mesh.in_motion());
  REQUIRE(parts.messages.prompt() != nullptr);
  CHECK(parts.messages.prompt()->title == "This is no virtual control volume");
}

}  // namespace winslow::gui::test
