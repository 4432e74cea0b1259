#include "core/drag/drag_grip.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/error.h"
#include "core/motion/rigid_motion.h"

namespace winslow {

namespace {

template <typename Vector>
DisplacementTable displacements(const DragGrip& grip, const Vector& translate) {
  DisplacementTable table;
  table.source = "drag";
  table.entries.reserve(grip.nodes.size());
  for (std::size_t i = 0; i < grip.nodes.size(); ++i) {
    const Vector by = grip.shares[i] * translate;
    DisplacementEntry& entry = table.entries.emplace_back();
    entry.node = grip.nodes[i];
    entry.displacement = by.template head<2>();
    if constexpr (std::is_same_v<Vector, Vec3>) entry.displacement_z = by.z();
  }
  return table;
}

void check_shares(const DragGrip& grip, double rotate) {
  if (grip.shares.size() != grip.nodes.size())
    throw UsageError("a part of a boundary needs a share of the motion for each of its nodes");
  if (rotate != 0) throw UsageError("a part of a boundary can be moved, but not turned");
}

template <typename Pose>
Command command_of(const DragGrip& grip, const Pose& motion, const MotionOptions& how,
                   const SmoothOptions& smooth) {
  if (grip.rigid()) return MoveCommand{grip.markers, motion, how, smooth};
  check_shares(grip, motion.rotate);
  return DeformCommand{grip.markers, displacements(grip, motion.translate), how, smooth};
}

template <typename Pose>
Pose between(const DragGrip& grip, const Pose& from, const Pose& to) {
  if (grip.rigid()) return compose(inverse(from), to);
  Pose motion;
  motion.translate = to.translate - from.translate;
  return motion;
}

/// Distances along a loop from a position, in one direction, until they pass `radius`.
template <class Visit>
void walk(const std::vector<Index>& loop, const Coordinates& x, std::size_t from, bool forward,
          double radius, const Visit& visit) {
  const std::size_t n = loop.size();
  double distance = 0;
  std::size_t at = from;
  for (std::size_t step = 1; step < n; ++step) {
    const std::size_t next = forward ? (at + 1) % n : (at + n - 1) % n;
    distance += (x.xy(loop[next]) - x.xy(loop[at])).norm();
    if (distance >= radius) return;
    visit(next, distance);
    at = next;
  }
}

}  // namespace

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const DragGrip& grip, const RigidMotion& motion) {
  if (grip.rigid()) return make_motion(topology, rest, grip.markers, motion);
  check_shares(grip, motion.rotate);
  return make_motion(topology, rest, grip.markers, displacements(grip, motion.translate));
}

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const DragGrip& grip, const SpaceMotion& motion) {
  if (grip.rigid()) return make_motion(topology, rest, grip.markers, motion);
  check_shares(grip, motion.rotate);
  return make_motion(topology, rest, grip.markers, displacements(grip, motion.translate));
}

Command drag_command(const DragGrip& grip, const RigidMotion& motion, const MotionOptions& how,
                     const SmoothOptions& smooth) {
  return command_of(grip, motion, how, smooth);
}
Command drag_command(const DragGrip& grip, const SpaceMotion& motion, const MotionOptions& how,
                     const SmoothOptions& smooth) {
  return command_of(grip, motion, how, smooth);
}

RigidMotion motion_between(const DragGrip& grip, const RigidMotion& from, const RigidMotion& to) {
  return between(grip, from, to);
}
SpaceMotion motion_between(const DragGrip& grip, const SpaceMotion& from, const SpaceMotion& to) {
  return between(grip, from, to);
}

template <int D>
RigidMotionIn<D> fit_motion(std::span<const Index> nodes, std::span<const double> shares,
                            const Coordinates& rest, const Coordinates& x) {
  if (shares.empty()) {
    if constexpr (D == 2)
      return fit_rigid_motion(nodes, rest, x);
    else
      return fit_space_motion(nodes, rest, x);
  }
  const Points<D> before(rest), after(x);
  Vec<D> sum = Vec<D>::Zero();
  double weight = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    sum += shares[i] * (after[nodes[i]] - before[nodes[i]]);
    weight += shares[i] * shares[i];
  }
  RigidMotionIn<D> motion;
  if (weight > 0) motion.translate = sum / weight;
  return motion;
}
template RigidMotion fit_motion<2>(std::span<const Index>, std::span<const double>,
                                   const Coordinates&, const Coordinates&);
template SpaceMotion fit_motion<3>(std::span<const Index>, std::span<const double>,
                                   const Coordinates&, const Coordinates&);

double faded_share(double distance, double radius) {
  if (!(distance < radius)) return 0;
  const double t = distance / radius;
  return 1 - t * t * (3 - 2 * t);
}

FadedArc faded_arc(const std::vector<Index>& loop, const Coordinates& x, std::size_t first,
                   std::size_t last, double radius) {
  const std::size_t n = loop.size();
  std::vector<double> share(n, 0.0);
  for (std::size_t at = first;; at = (at + 1) % n) {
    share[at] = 1;
    if (at == last) break;
  }
  const auto fade = [&](std::size_t at, double distance) {
    share[at] = std::max(share[at], faded_share(distance, radius));
  };
  walk(loop, x, last, true, radius, fade);
  walk(loop, x, first, false, radius, fade);
  FadedArc arc;
  for (std::size_t at = 0; at < n; ++at) {
    if (share[at] <= 0) continue;
    arc.nodes.push_back(loop[at]);
    arc.shares.push_back(share[at]);
  }
  return arc;
}

}  // namespace winslow
