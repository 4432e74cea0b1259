#pragma once

#include "gui/render/view.h"

namespace winslow::gui {

/// The places that the user has looked at, to go back to and forward from. A view counts once it
/// has rested; what one passes through while panning and zooming does not.
class ViewHistory {
 public:
  /// Another mesh: forgets everything.
  void clear();
  /// In every frame. busy: the mouse is changing the view. seconds: since the last frame.
  void observe(const LookedAt& now, bool busy, double seconds);
  /// The view is about to jump elsewhere: where it is now counts.
  void leave(const LookedAt& now);

  bool can_go_back(const LookedAt& now) const;
  bool can_go_forward() const { return position_ + 1 < views_.size(); }
  /// Where that leads; none: nowhere.
  std::optional<LookedAt> back(const LookedAt& now);
  std::optional<LookedAt> forward();

 private:
  std::vector<LookedAt> views_;
  std::size_t position_ = 0;
  LookedAt last_;
  double rested_ = 0;  // seconds
};

}  // namespace winslow::gui
