#include "gui/view/navigation/view_history.h"

#include <algorithm>
#include <cmath>

namespace winslow::gui {

namespace {

constexpr double rest_seconds = 0.4;
constexpr std::size_t most_views = 100;

}  // namespace

bool ViewHistory::same(const View& a, const View& b) {
  const double unit = std::min(a.units_per_pixel, b.units_per_pixel);
  return (a.centre - b.centre).cwiseAbs().maxCoeff() < 0.5 * unit &&
         std::abs(a.units_per_pixel - b.units_per_pixel) < 1e-3 * unit;
}

void ViewHistory::clear() {
  views_.clear();
  position_ = 0;
  rested_ = 0;
}

void ViewHistory::observe(const Camera& camera, bool busy, double seconds) {
  const View now = view_of(camera);
  rested_ = busy || !same(now, last_) ? 0 : rested_ + seconds;
  last_ = now;
  if (rested_ >= rest_seconds) leave(camera);
}

void ViewHistory::leave(const Camera& camera) {
  const View now = view_of(camera);
  if (!views_.empty()) {
    if (same(views_[position_], now)) return;
    views_.resize(position_ + 1, now);
  }
  views_.push_back(now);
  if (views_.size() > most_views) views_.erase(views_.begin());
  position_ = views_.size() - 1;
}

bool ViewHistory::can_go_back(const Camera& camera) const {
  return position_ > 0 || (!views_.empty() && !same(views_[position_], view_of(camera)));
}

void ViewHistory::back(Camera& camera) {
  leave(camera);
  if (position_ == 0) return;
  --position_;
  camera.look_at(views_[position_].centre, views_[position_].units_per_pixel);
}

void ViewHistory::forward(Camera& camera) {
  if (!can_go_forward()) return;
  ++position_;
  camera.look_at(views_[position_].centre, views_[position_].units_per_pixel);
}

}  // namespace winslow::gui
