#include "gui/panels/convergence_panel.h"

#include <algorithm>

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

}  // namespace

void ConvergencePanel::draw(const PanelContext& context) {
  const Session& session = context.session;
  ImGui::PushFont(context.theme.bold);
  const std::string title = title_of(session);
  ImGui::TextUnformatted(ui::elided(title, ImGui::GetContentRegionAvail().x).c_str());
  ImGui::PopFont();
  const auto history = session.convergence();
  ImVec2 size = ImGui::GetContentRegionAvail();
  size.x = std::max(size.x, 1.0f);
  size.y = std::max(size.y, 1.0f);
  const ImVec2 start = ImGui::GetCursorScreenPos();
  // A field being typed in holds all sorts of numbers.
  const double tolerance = session.smooth_options().tolerance;
  ConvergencePlot plot{history, {}};
  if (tolerance > 0) plot.tolerance = tolerance;
  draw_convergence_plot("convergence/plot", plot, size, context.theme.scale);
  if (!history.empty()) return;
  const char* hint = "Move a body or press Smooth: the residual of every iteration appears here.";
  const ImVec2 text = ImGui::CalcTextSize(hint);
  if (text.x > size.x) return;
  ImGui::GetWindowDrawList()->AddText(
      ImVec2(start.x + (size.x - text.x) / 2, start.y + (size.y - text.y) / 2),
      palette().text_faint, hint);
}

}  // namespace winslow::gui
