#include "gui/view/overlays/mouse_labels.h"

#include <cstdio>

#include "gui/document/jobs/body_drag.h"

namespace winslow::gui {

namespace {

ImVec2 beside_mouse(const View& view, const Theme& theme, const ImVec2& size) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ScreenBox seen = view.viewport();
  const ImVec2 start = static_cast<ImVec2>(seen.min);
  const float right = start.x + static_cast<float>(seen.size().x());
  const float bottom = start.y + static_cast<float>(seen.size().y());
  ImVec2 at(mouse.x + theme.px(18), mouse.y + theme.px(14));
  if (at.x + size.x > right) at.x = std::max(start.x, mouse.x - theme.px(12) - size.x);
  if (at.y + size.y > bottom) at.y = std::max(start.y, mouse.y - theme.px(8) - size.y);
  return at;
}

}  // namespace

void draw_beside_mouse(ImDrawList& list, const View& view, const Theme& theme,
                       const std::vector<MouseLabel>& labels) {
  const float pad = theme.px(7);
  const float height = ImGui::GetTextLineHeight() + 1.4f * pad;
  const float step = height + theme.px(3);
  float width = 0;
  for (const MouseLabel& label : labels)
    width = std::max(width, ImGui::CalcTextSize(label.text.c_str()).x + 2 * pad);
  ImVec2 at = beside_mouse(view, theme, ImVec2(width, static_cast<float>(labels.size()) * step));
  for (const MouseLabel& label : labels) {
    const ImVec2 size = ImGui::CalcTextSize(label.text.c_str());
    list.AddRectFilled(at, ImVec2(at.x + size.x + 2 * pad, at.y + height),
                       faded(label.background, 0.88f), theme.px(5));
    list.AddText(ImVec2(at.x + pad, at.y + 0.7f * pad), palette().card, label.text.c_str());
    at.y += step;
  }
}

std::vector<MouseLabel> drag_labels(std::string motion, const Session& session) {
  std::vector<MouseLabel> labels{{std::move(motion), palette().text}};
  const BodyDrag* drag = session.mesh().work().body_drag();
  if (!drag || drag->reach() == BodyDrag::Reach::there) return labels;
  if (drag->reach() == BodyDrag::Reach::limit)
    labels.push_back({blocked_text(*drag), palette().danger});
  else
    labels.push_back({updating_text(*drag), palette().text_dim});
  return labels;
}

std::string typed_field(const TypedMotion& typed, std::size_t field) {
  const bool here = typed.field() == field;
  const std::string& text = typed.text(field);
  return (text.empty() && !here ? "0" : text) + (here ? "|" : "");
}

std::string label_number(double value, const char* format) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

}  // namespace winslow::gui
