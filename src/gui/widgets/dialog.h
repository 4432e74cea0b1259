#pragma once

#include <string>

#include "gui/widgets/theme.h"

namespace winslow::gui::ui {

/// Puts the next window, which is as large as its content, in the middle of the screen and keeps it
/// within. Returns the width of its content, pixels: `wanted`, or what a small screen leaves of it.
/// padding: between the content and the frame, pixels.
float place_dialog(float wanted, const ImVec2& padding);

/// A dialog in the middle of the window, which holds all else back while it is open. Draw its
/// content while shown() and only then.
class Dialog {
 public:
  /// `id`: unique. wanted: open it now; taken back.
  Dialog(const char* id, const std::string& title, bool& wanted, const Theme& theme);
  ~Dialog();
  Dialog(const Dialog&) = delete;
  Dialog& operator=(const Dialog&) = delete;

  bool shown() const { return shown_; }
  /// Two buttons at the foot. cancelled is also true after Esc; either closes the dialog.
  struct Answer {
    bool accepted = false, cancelled = false;
  };
  Answer buttons(const std::string& id, const std::string& accept, bool enabled = true);

 private:
  const Theme& theme_;
  float width_;
  bool shown_ = false;
};

}  // namespace winslow::gui::ui
