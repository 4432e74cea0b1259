#include "core/motion/meshes_between.h"

#include <algorithm>
#include <cmath>

#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

constexpr double degrees_per_frame = 1;
constexpr double moved_per_frame = 0.02;  // of the extent of the moved nodes
constexpr int most_frames = 90;

/// The share of a rigid motion: the angle and the way of its centre, each in proportion.
RigidMotion share_of(const RigidMotion& whole, const Vec2& centre, double share) {
  const Vec2 way = transform(whole, centre) - centre;
  return {share * whole.rotate, centre, share * way};
}

int frames_for(const RigidMotion& motion, const Bounds& body) {
  const Vec2 centre = body.centre();
  const double extent = body.size().norm();
  const double way = (transform(motion, centre) - centre).norm();
  const double by_way = extent > 0 ? way / (moved_per_frame * extent) : 0;
  const double wanted = std::max(std::abs(motion.rotate) / degrees_per_frame, by_way);
  return static_cast<int>(std::ceil(std::min(wanted, static_cast<double>(most_frames)) - 1e-9));
}

}  // namespace

std::vector<Coordinates> meshes_between(const Topology& topology, std::span<const Index> moved,
                                        const Coordinates& from, const Coordinates& to) {
  if (moved.empty() || from.size() != to.size()) return {};
  const RigidMotion whole = fit_rigid_motion(moved, from, to);
  const Bounds body = bounds(from, moved);
  const Vec2 centre = body.centre();
  const int frames = frames_for(whole, body);
  std::vector<Coordinates> between;
  for (int k = 1; k < frames; ++k) {
    const double t = static_cast<double>(k) / frames;
    const RigidMotion part = share_of(whole, centre, t);
    Coordinates x = from;
    for (Index i = 0; i < x.size(); ++i) {
      const Vec2 a = from.xy(i), b = to.xy(i);
      // Straight for what stays, with the body for what goes along: thin layers at a body that
      // turns would be crushed by straight lines.
      const double stays = (b - a).norm(), goes = (b - transform(whole, a)).norm();
      const double along = stays + goes > 0 ? stays / (stays + goes) : 0;
      const Vec2 straight = a + t * (b - a);
      const Vec2 carried = transform(part, a + t * (transform_back(whole, b) - a));
      x.set_xy(i, straight + along * (carried - straight));
    }
    if (check_validity(topology, x).inverted == 0) between.push_back(std::move(x));
  }
  return between;
}

}  // namespace winslow
