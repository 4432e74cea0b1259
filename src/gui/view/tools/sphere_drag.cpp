#include "gui/view/tools/sphere_drag.h"

#include <algorithm>
#include <cmath>

#include "core/vcv/sphere/sphere_edit.h"
#include "core/vcv/sphere/sphere_start.h"

namespace winslow::gui {

namespace {

constexpr double least_share = 0.02;    // of the equal solid angle
constexpr double shortest_share = 0.1;  // of the mean length
constexpr int halvings = 24;

/// On the way from one unit vector to another; of opposite ones there is none.
Vec3 between(const Vec3& a, const Vec3& b, double share) {
  const Vec3 sum = (1 - share) * a + share * b;
  return sum.norm() > 1e-9 ? Vec3(sum.normalized()) : a;
}

}  // namespace

SphereDrag::SphereDrag(const VolumeNodalView& view, std::size_t edge)
    : link_(view.link), node_(view.node), neighbours_(view.neighbours), edge_(edge) {
  for (const Vec3& p : view.vcv.points) stencil_.directions.push_back(p.normalized());
  stencil_.lengths = view.vcv.lengths;
  const double start = least_angle_at(link_, stencil_.directions, static_cast<Index>(edge_)).share;
  least_ = std::min(least_share, 0.5 * start);  // one of a recipe may be narrower
  shortest_ = std::min(shortest_share * view.vcv.mean_length(), stencil_.lengths[edge_]);
}

std::optional<Index> SphereDrag::turned_over(const Vec3& direction) const {
  std::vector<Vec3> directions = stencil_.directions;
  directions[edge_] = direction;
  const LeastAngle least = least_angle_at(link_, directions, static_cast<Index>(edge_));
  const bool good = least.share >= least_ && covers_sphere(link_, directions);
  return good ? std::nullopt : std::optional(least.triangle);
}

void SphereDrag::turn_to(const Vec3& direction) {
  Vec3& now = stencil_.directions[edge_];
  const Vec3 wanted = direction.normalized();
  stopped_by_ = turned_over(wanted);
  if (!stopped_by_) {
    now = wanted;
    return;
  }
  double valid = 0, beyond = 1;
  const Vec3 from = now;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (valid + beyond);
    if (const auto over = turned_over(between(from, wanted, middle))) {
      beyond = middle;
      stopped_by_ = over;
    } else {
      valid = middle;
    }
  }
  now = between(from, wanted, valid);
}

void SphereDrag::stretch_to(double length, double longest) {
  stopped_by_.reset();
  stencil_.lengths[edge_] = std::clamp(length, shortest_, std::max(longest, shortest_));
}

VcvEdit SphereDrag::edit() const {
  return {node_, neighbours_, {}, stencil_.lengths, stencil_.directions};
}

std::vector<Vec3> SphereDrag::points() const {
  std::vector<Vec3> points = stencil_.directions;
  for (std::size_t k = 0; k < points.size(); ++k) points[k] *= stencil_.lengths[k];
  return points;
}

}  // namespace winslow::gui
