#include "gui/document/session/message_board.h"

#include <algorithm>

#include "core/quality/quality.h"
#include "gui/support/session_parts.h"

namespace winslow::gui::test {

TEST_CASE("questions wait in the order in which they were asked") {
  const LiveMesh mesh;
  MessageBoard board(mesh);
  CHECK(board.prompt() == nullptr);
  board.ask({Prompt::Kind::question, "First?", {}, {}});
  board.report_error("Second", "text");
  REQUIRE(board.prompt() != nullptr);
  CHECK(board.prompt()->title == "First?");
  board.apply(action::DismissPrompt{});
  REQUIRE(board.prompt() != nullptr);
  CHECK(board.prompt()->kind == Prompt::Kind::error);
  CHECK(board.prompt()->choices.size() == 1);
  board.apply(action::DismissPrompt{});
  CHECK(board.prompt() == nullptr);
  board.apply(action::DismissPrompt{});
}

TEST_CASE("the banner says what the mesh calls for until it is put away, for this mesh alone") {
  SessionParts parts(tangled_mesh());
  MessageBoard& board = parts.messages;
  REQUIRE(board.banner().has_value());
  CHECK(board.banner()->kind == Banner::Kind::inverted_input);
  // Where to look: the element that is worst.
  const auto sines =
      element_values(parts.mesh.document()->state().mesh, Metric::normalized_jacobian);
  const auto worst = static_cast<Index>(std::ranges::min_element(sines) - sines.begin());
  CHECK(board.banner()->worst == MeshItem{MeshItem::Kind::element, worst});
  CHECK_FALSE(board.banner_dismissed());
  board.apply(action::DismissBanner{});
  CHECK_FALSE(board.banner().has_value());
  CHECK(board.banner_dismissed());
  REQUIRE(parts.jobs.start(SmoothCommand{}, false));
  parts.finish();
  CHECK_FALSE(board.banner_dismissed());
}

TEST_CASE(
    "a motion that ended early is said before that it has not converged, not that it is bad") {
  const LiveMesh mesh;
  MessageBoard board(mesh);
  SmoothResult result;
  result.converged = false;
  board.set_banner(Banner::Kind::partial_motion, "half of the way");
  board.set_banner_of_result(result);
  CHECK(board.banner()->kind == Banner::Kind::partial_motion);
  result.inverted = 3;
  board.set_banner_of_result(result);
  CHECK(board.banner()->kind == Banner::Kind::inverted_result);
  board.clear_banner();
  result.inverted = 0;
  board.set_banner_of_result(result);
  CHECK(board.banner()->kind == Banner::Kind::not_converged);
  CHECK_FALSE(board.banner()->worst.has_value());
}

TEST_CASE("a command that spoils the cells at walls is named, in each place of the history") {
  SessionParts parts(ring_mesh(48, 24));
  MessageBoard& board = parts.messages;
  CHECK_FALSE(board.banner().has_value());
  SmoothCommand regular;  // makes cells of one shape of stretched ones
  regular.smooth.targets = TargetBlend::regular();
  REQUIRE(parts.jobs.start(regular, false));
  parts.finish();
  REQUIRE(board.banner().has_value());
  CHECK(board.banner()->kind == Banner::Kind::damaged);
  const std::string text = board.banner()->text;
  CHECK(text.starts_with("First heights changed by more than 5 %"));
  CHECK(text.find(" at (") != std::string::npos);
  CHECK(text.ends_with("avoid that."));
  REQUIRE(board.banner()->worst.has_value());
  CHECK(parts.mesh.topology()->on_boundary(board.banner()->worst->id));
  CHECK(board.banner()->worst->kind == MeshItem::Kind::node);
  REQUIRE(parts.jobs.start(regular, false));  // nothing changes any more
  parts.finish();
  CHECK_FALSE(board.banner().has_value());
  parts.history.apply(action::Undo{});
  REQUIRE(board.banner().has_value());
  CHECK(board.banner()->text == text);
  parts.history.apply(action::Undo{});
  CHECK_FALSE(board.banner().has_value());
}

}  // namespace winslow::gui::test
