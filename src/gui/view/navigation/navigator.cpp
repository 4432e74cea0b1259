#include "gui/view/navigation/navigator.h"

#include "gui/render/space/space_view.h"

namespace winslow::gui {

namespace {

constexpr double rest_seconds = 0.4;
constexpr std::size_t most_views = 100;

bool same(const LookedAt& a, const LookedAt& b) {
  const double unit = std::min(a.units_per_pixel, b.units_per_pixel);
  return a.direction == b.direction && (a.centre - b.centre).cwiseAbs().maxCoeff() < 0.5 * unit &&
         std::abs(a.units_per_pixel - b.units_per_pixel) < 1e-3 * unit;
}

}  // namespace

void ViewHistory::clear() {
  views_.clear();
  position_ = 0;
  rested_ = 0;
}

void ViewHistory::observe(const LookedAt& now, bool busy, double seconds) {
  rested_ = busy || !same(now, last_) ? 0 : rested_ + seconds;
  last_ = now;
  if (rested_ >= rest_seconds) leave(now);
}

void ViewHistory::leave(const LookedAt& now) {
  if (!views_.empty()) {
    if (same(views_[position_], now)) return;
    views_.resize(position_ + 1, now);
  }
  views_.push_back(now);
  if (views_.size() > most_views) views_.erase(views_.begin());
  position_ = views_.size() - 1;
}

bool ViewHistory::can_go_back(const LookedAt& now) const {
  return position_ > 0 || (!views_.empty() && !same(views_[position_], now));
}

std::optional<LookedAt> ViewHistory::back(const LookedAt& now) {
  leave(now);
  if (position_ == 0) return std::nullopt;
  return views_[--position_];
}

std::optional<LookedAt> ViewHistory::forward() {
  if (!can_go_forward()) return std::nullopt;
  return views_[++position_];
}

void Navigator::set_viewport(const ScreenBox& area) {
  plane_.view().set_viewport(area.min.x(), area.min.y(), area.size().x(), area.size().y());
  ScreenBox space = area;
  if (options_.comparison == Comparison::split) space = side_by_side(space, options_.divider).now;
  space_.view().set_viewport(space.min.x(), space.min.y(), space.size().x(), space.size().y());
}

void Navigator::leave_mesh() {
  history_.clear();
  space_.leave(options_);
}

void Navigator::begin_mesh() {
  if (session_.document()) camera_control().begin(options_);
}

void Navigator::on(const action::LookFrom& a) {
  // The plane is seen from above.
  if (!camera_control().view().turns()) return;
  leave();
  space_.look_from(named_view(a.name, options_.space.up));
}

void Navigator::go_to(const MeshItem& item) {
  leave();
  camera_control().go_to(item);
  stay_above_card();
}

void Navigator::show(const SpaceLook& look) {
  leave();
  space_.look_from({look.azimuth, look.elevation, look.up});
  space_.look_around(Vec3(look.centre.data()), look.radius);
  stay_above_card();
}

}  // namespace winslow::gui
