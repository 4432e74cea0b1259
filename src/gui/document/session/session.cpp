#include "gui/document/session/session.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "gui/document/jobs/body_drag.h"

namespace winslow::gui {

Session::Session() {
  mesh_.when_rebuilt([this](const auto& before, const auto& now) {
    quality_.clear();
    if (now) return selection_.follow(before, now);
    selection_.clear();
    jobs_.layer_preview().want({});
  });
}

void Session::apply(const DocumentAction& action) {
  std::visit([this](const auto& group) { apply_group(group); }, action);
}

bool Session::poll() {
  bool changed = files_.poll();
  changed |= history_.poll();
  changed |= quality_.poll();
  changed |= jobs_.poll();
  changed |= stars_.poll();
  changed |= roles_.poll();
  return changed;
}

bool Session::working() const {
  return files_.busy() || history_.busy() || quality_.busy() || jobs_.working() || stars_.busy() ||
         roles_.busy();
}

namespace {

Activity busy(std::string text) { return {Activity::Kind::busy, std::move(text)}; }

std::string percent_text(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

/// What a command does can be counted in shares of a motion.
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
  const std::string what = job.paused() ? "Paused" : "Solving";
  if (!moves_boundary(job.command())) return busy(what + where);
  return busy(what + ": " + percent_text(history.empty() ? 0 : history.back().fraction) +
              " of the motion" + where);
}

namespace {

/// 0: none are known.
int known_layers(const Session& session, const LayerWall& wall) {
  const auto stack = session.mesh().layers();
  return stack ? layer_count(*stack, *session.topology(), wall) : 0;
}

}  // namespace

bool all_held(const Session& session, const std::vector<LayerWall>& walls) {
  const auto stack = session.mesh().layers();
  return stack && stack->held && std::ranges::all_of(walls, [&](const LayerWall& wall) {
           return known_layers(session, wall) > 0;
         });
}

void limit_to_present_layers(const Session& session, LayersCommand& command) {
  for (LayerWall& wall : command.layers.walls) {
    const int known = known_layers(session, wall);
    if (known > 0)
      wall.spacing.count = known;
    else if (command.task == LayerTask::hold)
      wall.spacing.count = every_layer;
  }
}

}  // namespace winslow::gui
