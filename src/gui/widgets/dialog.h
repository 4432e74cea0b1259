#pragma once

#include <string>

#include "gui/studio/theme.h"

namespace winslow::gui::ui {

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
  bool shown_ = false;
};

}  // namespace winslow::gui::ui
