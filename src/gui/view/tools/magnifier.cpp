#include "gui/view/tools/magnifier.h"

#include <algorithm>
#include <cmath>

namespace winslow::gui {

namespace {

constexpr double lens_side = 230;  // units of the layout
constexpr double pinned_side = 270;
constexpr double margin = 14;

}  // namespace

std::optional<Inset> magnifier_inset(const Magnifier& magnifier, const Camera& camera,
                                     const ScreenPoint& mouse, bool mouse_over, double scale) {
  if (!magnifier.on) return std::nullopt;
  const bool pinned = magnifier.pin.has_value();
  if (!pinned && !mouse_over) return std::nullopt;
  const ScreenPoint origin = camera.viewport_origin();
  const ScreenVector size(camera.viewport_width(), camera.viewport_height());
  const double side = std::floor(
      std::min((pinned ? pinned_side : lens_side) * scale, 0.6 * std::min(size.x(), size.y())));
  if (side < 40) return std::nullopt;
  Inset inset;
  inset.pinned = pinned;
  const Vec2 place =
      pinned ? Vec2((*magnifier.pin)[0], (*magnifier.pin)[1]) : camera.to_world(mouse);
  ScreenPoint corner;
  if (pinned) {
    // Bottom left: the legend is at the right.
    corner =
        ScreenPoint(origin.x() + margin * scale, origin.y() + size.y() - side - margin * scale);
  } else {
    const ScreenPoint wanted = mouse - ScreenVector(side / 2, side / 2);
    const ScreenPoint last = origin + size - ScreenVector(side, side);
    corner = {std::min(std::max(wanted.x(), origin.x()), last.x()),
              std::min(std::max(wanted.y(), origin.y()), last.y())};
  }
  corner = ScreenPoint(std::round(corner.x()), std::round(corner.y()));
  inset.camera.set_viewport(corner.x(), corner.y(), side, side);
  inset.camera.look_at(place, camera.units_per_pixel() / magnifier.factor);
  const ScreenPoint centre = camera.to_screen(place);
  const double half_side = 0.5 * side / magnifier.factor;
  const ScreenVector half(half_side, half_side);
  inset.source = {centre - half, centre + half};
  return inset;
}

double turned_factor(double factor, double notches) {
  return std::clamp(factor * std::pow(1.25, notches), 2.0, 1000.0);
}

}  // namespace winslow::gui
