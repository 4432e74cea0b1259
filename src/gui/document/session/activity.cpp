#include "gui/document/session/activity.h"

#include "gui/document/jobs/drag_text.h"

namespace winslow::gui {

namespace {

Activity busy(std::string text) { return {Activity::Kind::busy, std::move(text)}; }

}  // namespace

Activity activity_of(const Session& session) {
  if (session.files().loading())
    return busy("Reading " + session.files().loading_path().filename().string() + " ...");
  if (session.files().saving()) return busy("Saving ...");
  if (const BodyDrag* drag = session.mesh().body_drag()) {
    if (drag->reach() == BodyDrag::Reach::limit)
      return {Activity::Kind::blocked, blocked_text(*drag) + "; Esc cancels"};
    if (drag->reach() == BodyDrag::Reach::catching_up)
      return busy(updating_text(*drag) + "; Esc cancels");
  }
  if (session.dragging()) return busy("Dragging; Enter accepts, Esc cancels");
  if (session.mesh().held().vcv) return busy("Dragging a control volume; Esc cancels");
  const JobRunner& job = session.job();
  if (!job.active()) return {};
  const auto history = session.mesh().convergence();
  const std::string where =
      history.empty() ? "" : ", iteration " + std::to_string(history.back().iteration);
  return busy((job.paused() ? "Paused" : "Solving") + where);
}

}  // namespace winslow::gui
