#pragma once

namespace winslow::gui {

/// Pixels per unit of the layout: what the user chose, or what the screen wants, as far as the
/// window has room for it.
class InterfaceScale {
 public:
  /// screen: what the screen wants.
  explicit InterfaceScale(float screen) : screen_(screen) {}
  void set_screen(float scale) { screen_ = scale; }
  float screen() const { return screen_; }
  /// Size of the window, pixels.
  void set_window(int width, int height);

  /// chosen: by the user; 0: as the screen wants it.
  float of(double chosen) const;
  /// `wanted`, or the largest step of `scales` below it that the window has room for.
  float fitting(double wanted) const;

 private:
  float screen_;
  int width_ = 1, height_ = 1;
};

}  // namespace winslow::gui
