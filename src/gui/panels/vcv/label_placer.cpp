#include "gui/panels/vcv/label_placer.h"

#include <algorithm>

namespace winslow::gui {

void LabelPlacer::block(const ImVec2& centre, float half) {
  taken_.push_back(
      {ImVec2(centre.x - half, centre.y - half), ImVec2(centre.x + half, centre.y + half)});
}

bool LabelPlacer::is_free(const Rect& rect) const {
  const bool inside =
      rect.min.x >= min_.x && rect.min.y >= min_.y && rect.max.x <= max_.x && rect.max.y <= max_.y;
  if (!inside) return false;  // nor are numbers that are none
  return std::none_of(taken_.begin(), taken_.end(), [&](const Rect& other) {
    return rect.min.x < other.max.x && rect.max.x > other.min.x && rect.min.y < other.max.y &&
           rect.max.y > other.min.y;
  });
}

bool LabelPlacer::place(const ImVec2& centre, const std::string& text, ImU32 color,
                        ImU32 background) {
  const ImVec2 size = font_->CalcTextSizeA(font_->FontSize, 1e6f, 0, text.c_str());
  const Rect rect{ImVec2(centre.x - size.x / 2 - 1, centre.y - size.y / 2),
                  ImVec2(centre.x + size.x / 2 + 1, centre.y + size.y / 2)};
  if (!is_free(rect)) return false;
  taken_.push_back(rect);
  if (background != 0) list_.AddRectFilled(rect.min, rect.max, background, 2);
  list_.AddText(font_, font_->FontSize, ImVec2(rect.min.x + 1, rect.min.y), color, text.c_str());
  return true;
}

}  // namespace winslow::gui
