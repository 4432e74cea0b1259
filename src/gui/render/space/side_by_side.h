#pragma once

#include "gui/base/screen.h"

namespace winslow::gui {

/// Two meshes side by side in a view: where each is seen.
struct SideBySide {
  ScreenBox before, now;
};
/// divider: share of the width left of it, less than 1.
inline SideBySide side_by_side(const ScreenBox& whole, double divider) {
  const double middle = whole.min.x() + divider * whole.size().x();
  return {{whole.min, {middle, whole.max.y()}}, {{middle, whole.min.y()}, whole.max}};
}
/// The view of which the mesh now has its part.
inline ScreenBox whole_of(const ScreenBox& now, double divider) {
  return {{now.max.x() - now.size().x() / (1 - divider), now.min.y()}, now.max};
}

}  // namespace winslow::gui
