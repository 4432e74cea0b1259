#include "gui/view/tools/vcv_drag.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  // The angles of two edges are fixed: 180 degrees each.
  if (constraint != Constraint::length_only && n > 2 && point.norm() > 0) {
    double& before = edit.angles[(edge_ + n - 1) % n];
    double& after = edit.angles[edge_];
    const double sum = before + after;
    double turned = degrees(std::atan2(point.y(), point.x())) - before_;
    turned -= 360 * std::floor(turned / 360);
    // Beyond both neighbours, the nearer of them.
    if (turned > 0.5 * (sum + 360)) turned -= 360;
    // A VCV of a recipe may have wider and narrower angles than a drag makes.
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

}  // namespace winslow::gui
