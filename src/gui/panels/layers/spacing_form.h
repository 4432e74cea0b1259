#pragma once

#include <vector>

#include "core/layers/layer_spacing.h"

namespace winslow::gui {

/// Fields for the heights of layers at a wall.
class SpacingForm {
 public:
  void draw();
  /// What the fields say.
  LayerSpacing spacing() const;
  /// Puts other numbers into the fields.
  void set(const LayerSpacing& spacing);
  /// Heights that the fields ask for; none while they make no sense.
  std::vector<double> heights() const;

 private:
  void draw_first();
  void draw_total();

  LayerSpacing spacing_;
  double total_ = 0.1;
  bool has_total_ = false, from_y_plus_ = false;
  double y_plus_ = 1, reynolds_ = 1e6, length_ = 1;
};

}  // namespace winslow::gui
