#include "gui/panels/convergence_panel.h"

#include <algorithm>
#include <string>
#include <variant>

#include "gui/widgets/controls.h"
#include "gui/widgets/convergence_plot.h"

namespace winslow::gui {

namespace {

std::string title_of(const Session& session) {
  if (session.job().active()) return "Convergence: " + describe(session.job().command());
  const Document* document = session.document();
  if (!document || document->history().position() == 0) return "Convergence";
  return "Convergence: " + describe(document->history().command(document->history().position()));
}

/// Tolerance that the iterations shown were to reach: that of their command, or of the next one.
double tolerance_of(const Session& session) {
  const auto of = [&](const Command& command) {
    return std::visit(
        [&](const auto& c) {
          if constexpr (requires { c.smooth; }) return c.smooth.tolerance;
          return session.jobs().smooth_options().tolerance;
        },
        command);
  };
  if (session.job().active()) return of(session.job().command());
  const Document* document = session.document();
  if (!document || document->history().position() == 0)
    return session.jobs().smooth_options().tolerance;
  return of(document->history().command(document->history().position()));
}

}  // namespace

void ConvergencePanel::draw_strip(const PanelContext& context) {
  ImGui::AlignTextToFramePadding();
  ImGui::PushFont(context.theme.bold);
  ImGui::TextUnformatted("Convergence");
  ImGui::PopFont();
  ui::note("convergence/strip");
  ImGui::SameLine(0, context.theme.px(16));
  ui::text_dim(
      ui::elided("Move a body or press Smooth: the residual of every iteration appears here.",
                 ImGui::GetContentRegionAvail().x));
}

void ConvergencePanel::draw_header(const PanelContext& context) {
  const Session& session = context.session;
  const std::string label = "Export CSV";
  const float button = ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::AlignTextToFramePadding();
  const float start = ImGui::GetCursorPosX();
  ImGui::PushFont(context.theme.bold);
  ImGui::TextUnformatted(
      ui::elided(title_of(session), room - button - context.theme.px(12)).c_str());
  ImGui::PopFont();
  ImGui::SameLine(start + room - button);
  if (ui::button("convergence/export", label,
                 {"Write every iteration shown here, with all its numbers, as a table for a "
                  "spreadsheet or a plotting program.",
                  ui::ButtonStyle::normal, !session.mesh().convergence().empty()}))
    context.emit(action::ShowFileDialog{FilePurpose::export_convergence});
  draw_convergence_key("convergence", series_, context.theme.scale);
}

bool ConvergencePanel::empty(const PanelContext& context) {
  if (context.session.job().active()) return false;
  const Document* document = context.session.document();
  if (!document) return true;
  // Of the whole history, so that the mesh does not jump when steps are undone.
  const History& history = document->history();
  for (std::size_t k = 1; k < history.size(); ++k)
    if (!history.result(k).history.empty()) return false;
  return true;
}

void ConvergencePanel::draw(const PanelContext& context) {
  const Session& session = context.session;
  if (empty(context)) return draw_strip(context);
  draw_header(context);
  const auto history = session.mesh().convergence();
  ImVec2 size = ImGui::GetContentRegionAvail();
  size.x = std::max(size.x, 1.0f);
  size.y = std::max(size.y, 1.0f);
  // A field being typed in holds all sorts of numbers.
  const double tolerance = tolerance_of(session);
  ConvergencePlot plot{history, {}, series_};
  if (tolerance > 0) plot.tolerance = tolerance;
  draw_convergence_plot("convergence/plot", plot, size, context.theme.scale);
}

}  // namespace winslow::gui
