#pragma once

#include <string>

#include "gui/widgets/theme.h"

namespace winslow::gui::ui {

/// Puts the next window, which is as large as its content, in the middle of the screen and keeps it
/// within. Returns the width of its content, pixels: `wanted`, or what a small screen leaves of it.
/// padding: between the content and the frame, pixels.
float place_dialog(float wanted, const ImVec2& padding);

/// A window in the middle of the screen without a title, which holds all else back while it is
/// open. Draw its content while shown() and only then.
class Modal {
 public:
  /// `id`: unique. open: it comes up now. padding: between the content and the frame, units of the
  /// layout. size: pixels; 0: as large as the content, for which place_dialog() has made room.
  struct Look {
    ImVec2 padding;
    ImVec2 size = ImVec2(0, 0);
    ImGuiWindowFlags flags = 0;  ///< beside those that all of them have
  };
  Modal(const char* id, bool open, const Theme& theme, const Look& look);
  ~Modal();
  Modal(const Modal&) = delete;
  Modal& operator=(const Modal&) = delete;
  bool shown() const { return shown_; }

 private:
  bool shown_ = false;
};

/// A question with its answers. Draw its content while shown() and only then.
class Dialog {
 public:
  /// `id`: unique. wanted: open it now; taken back.
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
