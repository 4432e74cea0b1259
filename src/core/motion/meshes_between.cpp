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

template <int D>
RigidMotionIn<D> fitted(std::span<const Index> moved, const Coordinates& from,
                        const Coordinates& to) {
  if constexpr (D == 2)
    return fit_rigid_motion(moved, from, to);
  else
    return fit_space_motion(moved, from, to);
}

template <int D>
Box<D> box_of(const Coordinates& x, std::span<const Index> nodes) {
  Box<D> box = Box<D>::empty();
  for (const Index node : nodes) box.add(x.get<D>(node));
  return box;
}

/// The share of a rigid motion: the angle and the way of its centre, each in proportion.
template <int D>
RigidMotionIn<D> share_of(RigidMotionIn<D> whole, const Vec<D>& centre, double share) {
  const Vec<D> way = transform(whole, centre) - centre;
  whole.rotate *= share;
  whole.pivot = centre;
  whole.translate = share * way;
  return whole;
}

template <int D>
int frames_for(const RigidMotionIn<D>& motion, const Box<D>& body) {
  const Vec<D> centre = body.centre();
  const double extent = body.size().norm();
  const double way = (transform(motion, centre) - centre).norm();
  const double by_way = extent > 0 ? way / (moved_per_frame * extent) : 0;
  const double wanted = std::max(std::abs(motion.rotate) / degrees_per_frame, by_way);
  return static_cast<int>(std::ceil(std::min(wanted, static_cast<double>(most_frames)) - 1e-9));
}

template <int D>
std::vector<Coordinates> between(const Topology& topology, std::span<const Index> moved,
                                 const Coordinates& from, const Coordinates& to) {
  const RigidMotionIn<D> whole = fitted<D>(moved, from, to);
  const Box<D> body = box_of<D>(from, moved);
  const int frames = frames_for<D>(whole, body);
  std::vector<Coordinates> meshes;
  for (int k = 1; k < frames; ++k) {
    const double t = static_cast<double>(k) / frames;
    const RigidMotionIn<D> part = share_of<D>(whole, body.centre(), t);
    Coordinates x = from;
    for (Index i = 0; i < x.size(); ++i) {
      const Vec<D> a = from.get<D>(i), b = to.get<D>(i);
      // Straight for what stays, with the body for what goes along: thin layers at a body that
      // turns would be crushed by straight lines.
      const double stays = (b - a).norm(), goes = (b - transform(whole, a)).norm();
      const double along = stays + goes > 0 ? stays / (stays + goes) : 0;
      const Vec<D> straight = a + t * (b - a);
      const Vec<D> back = transform_back(whole, b);
      const Vec<D> carried = transform(part, Vec<D>(a + t * (back - a)));
      x.set<D>(i, straight + along * (carried - straight));
    }
    if (check_validity(topology, x).inverted == 0) meshes.push_back(std::move(x));
  }
  return meshes;
}

}  // namespace

std::vector<Coordinates> meshes_between(const Topology& topology, std::span<const Index> moved,
                                        const Coordinates& from, const Coordinates& to) {
  if (moved.empty() || from.size() != to.size()) return {};
  return topology.cell_dimension() == 3 ? between<3>(topology, moved, from, to)
                                        : between<2>(topology, moved, from, to);
}

}  // namespace winslow
