#include "gui/document/session/settled_command.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/motion/rigid_motion.h"
#include "core/motion/space_motion.h"

namespace winslow::gui {

namespace {

/// The same motion said as turning about `pivot`, without the rounding errors that a fit leaves:
/// the history and recipes would show them. `size`: of the body.
RigidMotion about(const Vec2& pivot, const RigidMotion& motion, double size) {
  RigidMotion said{motion.rotate, pivot, transform(motion, pivot) - pivot};
  constexpr double rounding = 1e-11;
  if (std::abs(said.rotate) < 360 * rounding) said.rotate = 0;
  // Of coordinates, and of what the fit and the way from its centre to the pivot make of them.
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * pivot.norm();
  const double arm = (pivot - motion.pivot).norm();
  const double least = rounding * (size + arm + said.translate.norm()) + round_off;
  for (int d = 0; d < 2; ++d)
    if (std::abs(said.translate[d]) < least) said.translate[d] = 0;
  return said;
}

/// How far a body came of a motion that was asked for: of the way of its nodes.
double share_of(const RigidMotion& reached, const RigidMotion& asked, const Bounds& body) {
  const Vec2 centre = body.centre();
  const double radius = 0.5 * body.size().norm();
  const auto way = [&](const RigidMotion& from, const RigidMotion& to) {
    return std::abs(radians(to.rotate - from.rotate)) * radius +
           (transform(to, centre) - transform(from, centre)).norm();
  };
  const double whole = way({}, asked);
  return whole > 0 ? std::clamp(1 - way(reached, asked) / whole, 0.0, 1.0) : 1;
}

/// The same in space.
SpaceMotion about(const Vec3& pivot, const SpaceMotion& motion, double size) {
  SpaceMotion said{motion.rotate, motion.axis, pivot, transform(motion, pivot) - pivot};
  constexpr double rounding = 1e-11;
  if (std::abs(said.rotate) < 360 * rounding) said.rotate = 0;
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * pivot.norm();
  const double arm = (pivot - motion.pivot).norm();
  const double least = rounding * (size + arm + said.translate.norm()) + round_off;
  for (Index d = 0; d < 3; ++d)
    if (std::abs(said.translate[d]) < least) said.translate[d] = 0;
  return said;
}

/// Runs in space begin where their command does, so that their fraction is that of the whole.
double settle_in_space(MoveCommand& move, double fraction, const Mesh& base,
                       const Coordinates& now) {
  const std::vector<Index> nodes = base.topology->markers().nodes_of(move.markers);
  const SpaceMotion asked = move.motion.in_space(Vec3(0, 0, 0));
  const SpaceMotion fitted = with_turns(fit_space_motion(nodes, base.coordinates, now), asked.axis,
                                        fraction * asked.rotate);
  const double size = space_bounds(base.coordinates, nodes).size().norm();
  move.motion = about(asked.pivot, fitted, size);
  return fraction;
}

/// rest, now: positions before the motion and where it got to. Returns the share of the motion that
/// was reached.
double settle(MoveCommand& move, double fraction, const Mesh& base, const Coordinates& now,
              bool started_elsewhere) {
  if (base.topology->cell_dimension() == 3) return settle_in_space(move, fraction, base, now);
  const Coordinates& rest = base.coordinates;
  const std::vector<Index> nodes = base.topology->markers().nodes_of(move.markers);
  RigidMotion reached = fit_rigid_motion(nodes, rest, now);
  // Full turns do not show in where the body is.
  const double turned = (started_elsewhere ? 1 : fraction) * move.motion.rotate;
  reached.rotate += 360 * std::round((turned - reached.rotate) / 360);
  const Vec2 pivot = move.motion.pivot.value_or(Vec2(0, 0));
  const Bounds body = bounds(rest, nodes);
  // The fraction of a run that began on the way says nothing of the whole way.
  if (started_elsewhere) fraction = share_of(reached, move.motion.about(pivot), body);
  move.motion = about(pivot, reached, body.size().norm());
  return fraction;
}

void settle(DeformCommand& deform, double fraction, const Coordinates& rest,
            const Coordinates& now) {
  if (auto* sine = std::get_if<SineDeformation>(&deform.shape)) sine->amplitude *= fraction;
  auto* table = std::get_if<DisplacementTable>(&deform.shape);
  if (!table) return;
  for (DisplacementEntry& entry : table->entries) {
    if (entry.node && now.dimension() == 3) {
      const Vec3 by = now.xyz(*entry.node) - rest.xyz(*entry.node);
      entry.displacement = by.head<2>();
      entry.displacement_z = by.z();
    } else if (entry.node) {
      entry.displacement = now.xy(*entry.node) - rest.xy(*entry.node);
    } else {
      entry.displacement *= fraction;
      if (entry.displacement_z) *entry.displacement_z *= fraction;
    }
  }
}

}  // namespace

double settle_command(JobRunner::Outcome& outcome, const Mesh& base, bool started_elsewhere) {
  const double fraction = outcome.result->smooth.fraction_reached;
  if (fraction >= 1) return 1;
  const Coordinates& now = outcome.result->state.mesh.coordinates;
  if (auto* move = std::get_if<MoveCommand>(&outcome.command))
    return settle(*move, fraction, base, now, started_elsewhere);
  if (auto* deform = std::get_if<DeformCommand>(&outcome.command))
    settle(*deform, fraction, base.coordinates, now);
  return fraction;
}

}  // namespace winslow::gui
