#pragma once

#include <string>

#include "gui/widgets/theme.h"

namespace winslow::gui::ui {

/// Centres the next window, sized to its content, and keeps it within the screen. Returns the width
/// of its content, pixels: `wanted`, or less on a small screen. padding: between the content and
/// the frame, pixels.
float place_dialog(float wanted, const ImVec2& padding);

/// A modal window without a title in the middle of the screen. Draw its content only while shown()
/// is true.
class Modal {
 public:
  /// `id`: unique. open: opens it now. padding: between the content and the frame, units of the
  /// layout. size: pixels; 0: that of the content, placed by place_dialog().
  struct Look {
    ImVec2 padding;
    ImVec2 size = ImVec2(0, 0);
    ImGuiWindowFlags flags = 0;  ///< in addition to those of every modal
  };
  Modal(const char* id, bool open, const Theme& theme, const Look& look);
  ~Modal();
  Modal(const Modal&) = delete;
  Modal& operator=(const Modal&) = delete;
  bool shown() const { return shown_; }

 private:
  bool shown_ = false;
};

/// A modal question with its answers. Draw its content only while shown() is true.
class Dialog {
 public:
  /// `id`: unique. wanted: opens it now; reset to false.
  Dialog(const char* id, const std::string& title, bool& wanted, const Theme& theme);
  bool shown() const { return window_.shown(); }
  /// Two buttons at the foot. cancelled is also true after Esc; either closes the dialog.
  struct Answer {
    bool accepted = false, cancelled = false;
  };
  Answer buttons(const std::string& id, const std::string& accept, bool enabled = true);

 private:
  const Theme& theme_;
  float width_;
  Modal window_;
};

}  // namespace winslow::gui::ui
