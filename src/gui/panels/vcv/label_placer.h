#pragma once

#include <imgui.h>

#include <string>
#include <vector>

namespace winslow::gui {

/// Writes labels where there is room: one that would touch another is left out.
class LabelPlacer {
 public:
  LabelPlacer(ImDrawList& list, ImFont* font, const ImVec2& min, const ImVec2& max)
      : list_(list), font_(font), min_(min), max_(max) {}

  /// Keeps a square free of labels.
  void block(const ImVec2& centre, float half);
  /// Text around a point. True if there was room. background: behind the text; 0: none.
  bool place(const ImVec2& centre, const std::string& text, ImU32 color, ImU32 background = 0);

 private:
  struct Rect {
    ImVec2 min, max;
  };
  bool is_free(const Rect& rect) const;

  ImDrawList& list_;
  ImFont* font_;
  ImVec2 min_, max_;
  std::vector<Rect> taken_;
};

}  // namespace winslow::gui
