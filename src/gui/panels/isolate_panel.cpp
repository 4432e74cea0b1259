#include "gui/panels/isolate_panel.h"

#include <cmath>
#include <string>

#include "gui/base/text.h"
#include "gui/view/mesh/isolated_elements.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

void IsolatePanel::draw(const PanelContext& context) {
  if (!context.session.document() || !ui::section("section/isolate", "Isolate")) return;
  if (!context.view.color) {
    ui::text_dim("Colour the elements by a metric first (View).");
    return;
  }
  ViewOptions view = context.view;
  bool changed = ui::checkbox("isolate/on", "Isolate elements", view.isolation.on,
                              "Draw the elements beyond a threshold of the metric shown in full, "
                              "the others faint or not at all (I).");
  if (view.isolation.on) changed |= draw_threshold(context, view.isolation);
  if (changed) context.emit(action::EditView{difference(context.view, view)});
}

bool IsolatePanel::draw_threshold(const PanelContext& context, Isolation& isolation) {
  const std::string metric(field_info(*context.view.color).label);
  constexpr const char* tip = "Which elements stay. The line in the legend can be dragged, too.";
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ui::row(metric, tip, 0.5f);
  std::size_t side = isolation.above ? 1 : 0;
  ImGui::SetNextItemWidth(context.theme.px(72));
  bool changed = ui::combo("isolate/side", {"below", "above"}, side, tip);
  isolation.above = side == 1;
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(-FLT_MIN);
  changed |= ui::number("isolate/threshold", isolation.threshold, tip, "%.4g");
  constexpr const char* rest_tip = "How much of the other elements is seen; 0 hides them.";
  ui::row("Others", rest_tip, 0.5f);
  int percent = static_cast<int>(std::lround(100 * isolation.rest));
  if (ImGui::SliderInt("##isolate/rest", &percent, 0, 60, "%d %%")) {
    isolation.rest = percent / 100.0;
    changed = true;
  }
  ui::note("isolate/rest");
  ui::tooltip(rest_tip);
  const auto& measured = context.session.quality().latest();
  if (measured && measured->field == context.view.color)
    ui::text_dim(counted(isolated_count(measured->values, isolation), "element") + " of " +
                 grouped(static_cast<long long>(measured->values.size())));
  ui::note("isolate/count");
  return changed;
}

}  // namespace winslow::gui
