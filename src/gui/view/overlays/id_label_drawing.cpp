#include "gui/view/overlays/id_label_drawing.h"

#include <cmath>

#include "gui/view/overlays/view_overlay.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

ImVec2 id_label_size(const Theme& theme, const std::string& text) {
  return theme.small->CalcTextSizeA(theme.small->FontSize, 1e6f, 0, text.c_str());
}

void draw_id_label(ImDrawList& list, const Theme& theme, const IdLabel& label) {
  ImFont& font = *theme.small;
  const float pad = theme.px(3);
  const ImVec2 size = id_label_size(theme, label.text);
  const ImVec2 at(std::round(static_cast<float>(label.at.x()) - size.x / 2),
                  std::round(static_cast<float>(label.at.y()) - size.y / 2));
  const ImVec2 min(at.x - pad, at.y), max(at.x + size.x + pad, at.y + size.y);
  list.AddRectFilled(min, max, label.node ? palette().text : faded(palette().card, 0.8f),
                     theme.px(3));
  list.AddText(&font, font.FontSize, at, label.node ? palette().card : palette().text,
               label.text.c_str());
  ui::note((label.node ? "id/n" : "id/e") + label.text, min, max);
}

void draw_no_id_labels(ImDrawList& list, const Theme& theme, const ImVec2& at) {
  draw_tag(list, theme, at, "Zoom in to see the numbers");
  ui::note("id/none", at, ImVec2(at.x + 1, at.y + 1));
}

}  // namespace winslow::gui
