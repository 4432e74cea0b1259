#include "gui/view/tools/vcv_drag.h"

#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/sphere/sphere_fit.h"

namespace winslow::gui {

namespace {

constexpr double smallest_angle = 5, largest_angle = 175;  // degrees
constexpr double shortest = 0.1;                           // of the mean length

/// Direction of an edge, degrees from edge 0.
double direction(const VcvEdit& edit, std::size_t edge) {
  return std::accumulate(edit.angles.begin(),
                         edit.angles.begin() + static_cast<std::ptrdiff_t>(edge), 0.0);
}

}  // namespace

VcvDrag::VcvDrag(const NodalView& view, std::size_t edge) : edge_(edge) {
  start_.node = view.node;
  start_.neighbours = view.neighbours;
  for (const double angle : view.vcv.angles) start_.angles.push_back(degrees(angle));
  start_.lengths = view.vcv.lengths;
  before_ = direction(start_, edge_) -
            start_.angles[(edge_ + start_.angles.size() - 1) % start_.angles.size()];
}

VcvEdit VcvDrag::to(const Vec2& point, Constraint constraint, double longest) const {
  VcvEdit edit = start_;
  const std::size_t n = edit.angles.size();
  if (constraint != Constraint::angle_only) {
    const double mean =
        std::accumulate(edit.lengths.begin(), edit.lengths.end(), 0.0) / static_cast<double>(n);
    const double least = std::min(shortest * mean, edit.lengths[edge_]);
    edit.lengths[edge_] = std::clamp(point.norm(), least, std::max(longest, least));
  }
  // With two edges, the angles are fixed at 180 degrees each.
  if (constraint != Constraint::length_only && n > 2 && point.norm() > 0) {
    double& before = edit.angles[(edge_ + n - 1) % n];
    double& after = edit.angles[edge_];
    const double sum = before + after;
    double turned = degrees(std::atan2(point.y(), point.x())) - before_;
    turned -= 360 * std::floor(turned / 360);
    // Beyond both neighbours, the nearer one limits the angle.
    if (turned > 0.5 * (sum + 360)) turned -= 360;
    // The VCV of a recipe may have wider and narrower angles than a drag allows.
    const double least = std::min(smallest_angle, 0.5 * sum);
    const double most = std::max(largest_angle, 0.5 * sum);
    before = std::clamp(turned, std::max(least, sum - most), std::min(most, sum - least));
    after = sum - before;
  }
  return edit;
}

double VcvDrag::turn(const VcvEdit& edit) const {
  const std::size_t still = (edge_ + 1) % edit.angles.size();
  return radians(direction(start_, still) - direction(edit, still));
}

namespace {

constexpr double least_share = 0.02;    // of the equal solid angle
constexpr double shortest_share = 0.1;  // of the mean length
constexpr int halvings = 24;

/// Interpolates between two unit vectors; returns `a` where opposite ones cancel.
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
  least_ = std::min(least_share, 0.5 * start);  // a triangle of a recipe may be narrower
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
