#include "gui/panels/status_bar.h"

#include <cmath>
#include <string>
#include <variant>

#include "gui/base/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

struct State {
  std::string text;
  ImU32 color;
};

std::string percent_text(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

/// What a command does can be counted in shares of a motion.
bool moves_boundary(const Command& command) {
  return std::visit(
      [](const auto& c) {
        return requires { c.how; };
      },
      command);
}

State state_of(const Session& session) {
  if (session.files().loading())
    return {"Reading " + session.files().loading_path().filename().string() + " ...",
            palette().accent};
  if (session.files().saving()) return {"Saving ...", palette().accent};
  const JobRunner& job = session.job();
  if (const BodyDrag* drag = session.mesh().body_drag()) {
    if (drag->reach() == BodyDrag::Reach::limit)
      return {drag->limit() + "; Esc cancels", palette().danger};
    if (drag->reach() == BodyDrag::Reach::catching_up)
      return {"Dragging: updating mesh, " + percent_text(drag->frame().share) + "; Esc cancels",
              palette().accent};
  }
  if (session.dragging()) return {"Dragging; Enter accepts, Esc cancels", palette().accent};
  if (job.active()) {
    const auto history = session.mesh().convergence();
    const std::string where =
        history.empty() ? "" : ", iteration " + std::to_string(history.back().iteration);
    const std::string what = job.paused() ? "Paused" : "Solving";
    if (moves_boundary(job.command()))
      return {what + ": " + percent_text(history.empty() ? 0 : history.back().fraction) +
                  " of the motion" + where,
              palette().accent};
    return {what + where, palette().accent};
  }
  return {"Ready", palette().text_dim};
}

ImU32 notice_color(Notice::Kind kind) {
  if (kind == Notice::Kind::success) return palette().success;
  return kind == Notice::Kind::warning ? palette().warning : palette().text_dim;
}

void separator() {
  ImGui::SameLine(0, ImGui::GetFontSize());
  ui::text_colored(palette().border, "|");
  ImGui::SameLine(0, ImGui::GetFontSize());
}

void draw_mesh(const PanelContext& context) {
  const Topology& topology = *context.topology();
  separator();
  ui::text_dim(counted(topology.node_count(), "node"));
  separator();
  ui::text_dim(counted(topology.element_count(), "element"));
  separator();
  if (!context.shown) return;
  const Validity& validity = context.shown->validity;
  ui::text_dim("min sine " + table_number(validity.min_sine));
  ui::tooltip("Smallest sine of any corner angle. Positive: every element is valid.");
  separator();
  if (validity.inverted > 0)
    ui::text_colored(palette().danger, grouped(validity.inverted) + " inverted");
  else
    ui::text_dim("0 inverted");
}

}  // namespace

std::string StatusBar::state_text(const Session& session) { return state_of(session).text; }

void StatusBar::draw(const PanelContext& context) {
  ImGui::PushFont(context.theme.small);
  const State state = state_of(context.session);
  ui::text_colored(state.color, state.text);
  ui::note("status/state");
  if (context.session.document()) draw_mesh(context);
  if (const auto& notice = context.session.messages().notice()) {
    separator();
    const float room = ImGui::GetContentRegionAvail().x;
    ui::text_colored(notice_color(notice->kind), ui::elided(notice->text, room));
    ui::tooltip(notice->text);
  }
  ImGui::PopFont();
}

}  // namespace winslow::gui
