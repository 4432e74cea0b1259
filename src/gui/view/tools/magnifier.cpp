#include "gui/view/tools/magnifier.h"

#include <algorithm>
#include <cmath>

namespace winslow::gui {

namespace {

constexpr double lens_side = 230;  // units of the layout
constexpr double pinned_side = 270;
constexpr double margin = 14;

}  // namespace

Bounds Inset::frame() const {
  return {camera.viewport_origin(),
          camera.viewport_origin() + Vec2(camera.viewport_width(), camera.viewport_height())};
}

std::optional<Inset> magnifier_inset(const Magnifier& magnifier, const Camera& camera,
                                     const Vec2& mouse, bool mouse_over, double scale) {
  if (!magnifier.on) return std::nullopt;
  const bool pinned = magnifier.pin.has_value();
  if (!pinned && !mouse_over) return std::nullopt;
  const Vec2 origin = camera.viewport_origin();
  const Vec2 size(camera.viewport_width(), camera.viewport_height());
  const double side =
      std::floor(std::min((pinned ? pinned_side : lens_side) * scale, 0.6 * size.minCoeff()));
  if (side < 40) return std::nullopt;
  Inset inset;
  inset.pinned = pinned;
  const Vec2 place =
      pinned ? Vec2((*magnifier.pin)[0], (*magnifier.pin)[1]) : camera.to_world(mouse);
  Vec2 corner;
  if (pinned) {
    // Bottom left: the legend is at the right.
    corner = Vec2(origin.x() + margin * scale, origin.y() + size.y() - side - margin * scale);
  } else {
    corner = (mouse - Vec2::Constant(side / 2))
                 .cwiseMax(origin)
                 .cwiseMin(origin + size - Vec2::Constant(side));
  }
  corner = Vec2(std::round(corner.x()), std::round(corner.y()));
  inset.camera.set_viewport(corner.x(), corner.y(), side, side);
  inset.camera.look_at(place, camera.units_per_pixel() / magnifier.factor);
  const Vec2 centre = camera.to_screen(place);
  const Vec2 half = Vec2::Constant(0.5 * side / magnifier.factor);
  inset.source = {centre - half, centre + half};
  return inset;
}

double turned_factor(double factor, double notches) {
  return std::clamp(factor * std::pow(1.25, notches), 2.0, 1000.0);
}

}  // namespace winslow::gui
