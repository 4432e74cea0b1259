#include "gui/panels/status_bar.h"

#include <string>

#include "gui/base/text.h"
#include "gui/document/jobs/drag_text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

struct State {
  std::string text;
  ImU32 color;
};

State state_of(const Session& session) {
  if (session.files().loading())
    return {"Reading " + session.files().loading_path().filename().string() + " ...",
            palette().accent};
  if (session.files().saving()) return {"Saving ...", palette().accent};
  const JobRunner& job = session.job();
  if (const BodyDrag* drag = session.mesh().body_drag()) {
    if (drag->reach() == BodyDrag::Reach::limit)
      return {blocked_text(*drag) + "; Esc cancels", palette().danger};
    if (drag->reach() == BodyDrag::Reach::catching_up)
      return {updating_text(*drag) + "; Esc cancels", palette().accent};
  }
  if (session.dragging()) return {"Dragging; Enter accepts, Esc cancels", palette().accent};
  if (job.active()) {
    const auto history = session.mesh().convergence();
    const std::string where =
        history.empty() ? "" : ", iteration " + std::to_string(history.back().iteration);
    return {(job.paused() ? "Paused" : "Solving") + where, palette().accent};
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

void draw_mesh(const Session& session) {
  const Topology& topology = *session.topology();
  const auto history =
      session.job().active() ? session.mesh().convergence() : std::span<const IterationRecord>{};
  const auto& measured = session.quality().latest();
  const QualityReport& report = measured ? measured->report : session.document()->loaded_quality();
  Index inverted = history.empty() ? report.inverted : history.back().inverted;
  double sine = history.empty() ? report.of(Metric::normalized_jacobian).statistics.min
                                : history.back().min_sine;
  if (const BodyDrag* drag = session.mesh().body_drag()) {
    inverted = 0;  // its frames are valid, always
    sine = drag->frame().min_sine;
  }
  separator();
  ui::text_dim(counted(topology.node_count(), "node"));
  separator();
  ui::text_dim(counted(topology.element_count(), "element"));
  separator();
  ui::text_dim("min sine " + table_number(sine));
  ui::tooltip("Smallest sine of any corner angle. Positive: every element is valid.");
  separator();
  if (inverted > 0)
    ui::text_colored(palette().danger, grouped(inverted) + " inverted");
  else
    ui::text_dim("0 inverted");
}

}  // namespace

void StatusBar::draw(const PanelContext& context) {
  ImGui::PushFont(context.theme.small);
  const State state = state_of(context.session);
  ui::text_colored(state.color, state.text);
  ui::note("status/state");
  if (context.session.document()) draw_mesh(context.session);
  if (const auto& notice = context.session.messages().notice()) {
    separator();
    const float room = ImGui::GetContentRegionAvail().x;
    ui::text_colored(notice_color(notice->kind), ui::elided(notice->text, room));
    ui::tooltip(notice->text);
  }
  ImGui::PopFont();
}

}  // namespace winslow::gui
