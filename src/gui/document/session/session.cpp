#include "gui/document/session/session.h"

#include "gui/document/jobs/body_drag.h"

namespace winslow::gui {

Session::Session() {
  mesh_.when_rebuilt([this](const auto& before, const auto& now) {
    quality_.clear();
    if (now) return selection_.carry_over(before, now);
    selection_.clear();
    layers_.forget_mesh();
  });
}

void Session::apply(const DocumentAction& action) {
  std::visit([this](const auto& group) { apply_group(group); }, action);
}

bool Session::poll() {
  bool changed = files_.poll();
  changed |= history_.poll();
  changed |= quality_.poll();
  changed |= settings_.poll();
  changed |= layers_.poll();
  changed |= motions_.poll();
  changed |= jobs_.poll();
  changed |= inspection_.poll();
  return changed;
}

bool Session::working() const {
  return files_.busy() || history_.busy() || quality_.busy() || settings_.busy() ||
         layers_.busy() || motions_.busy() || jobs_.working() || inspection_.busy();
}

namespace {

Activity busy(std::string text) { return {Activity::Kind::busy, std::move(text)}; }

std::string percent_text(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

/// True if the progress of a command is a share of a motion.
bool moves_boundary(const Command& command) {
  return std::visit(
      [](const auto& c) {
        return requires { c.how; };
      },
      command);
}

}  // namespace

Activity activity_of(const Session& session) {
  if (session.files().loading())
    return busy("Reading " + session.files().loading_path().filename().string() + " ...");
  if (session.files().saving()) return busy("Saving ...");
  if (const BodyDrag* drag = session.mesh().work().body_drag()) {
    if (drag->reach() == BodyDrag::Reach::limit)
      return {Activity::Kind::blocked, blocked_text(*drag) + "; Esc cancels"};
    if (drag->reach() == BodyDrag::Reach::catching_up)
      return busy(updating_text(*drag) + "; Esc cancels");
  }
  if (session.dragging()) return busy("Dragging; Enter accepts, Esc cancels");
  if (session.mesh().work().held().vcv) return busy("Dragging a control volume; Esc cancels");
  const JobRunner& job = session.job();
  if (!job.active()) return {};
  const auto history = session.mesh().convergence();
  const std::string where =
      history.empty() ? "" : ", iteration " + std::to_string(history.back().iteration);
  const std::string what = job.paused() ? "Paused" : "Solving";
  if (!moves_boundary(job.command())) return busy(what + where);
  return busy(what + ": " + percent_text(history.empty() ? 0 : history.back().fraction) +
              " of the motion" + where);
}

}  // namespace winslow::gui
