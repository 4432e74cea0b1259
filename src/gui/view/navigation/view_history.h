#pragma once

#include <vector>

#include "gui/render/camera.h"

namespace winslow::gui {

/// The places that the user has looked at, to go back to and forward from. A view counts once it
/// has rested; what one passes through while panning and zooming does not.
class ViewHistory {
 public:
  /// Another mesh: forgets everything.
  void clear();
  /// In every frame. busy: the mouse is changing the view. seconds: since the last frame.
  void observe(const Camera& camera, bool busy, double seconds);
  /// The view is about to jump elsewhere: where it is now counts.
  void leave(const Camera& camera);

  bool can_go_back(const Camera& camera) const;
  bool can_go_forward() const { return position_ + 1 < views_.size(); }
  void back(Camera& camera);
  void forward(Camera& camera);

 private:
  struct View {
    Vec2 centre;
    double units_per_pixel;
  };
  static View view_of(const Camera& camera) { return {camera.centre(), camera.units_per_pixel()}; }
  static bool same(const View& a, const View& b);

  std::vector<View> views_;
  std::size_t position_ = 0;
  View last_{{0, 0}, 1};
  double rested_ = 0;  // seconds
};

}  // namespace winslow::gui
