#pragma once

#include <string>

#include "core/quality/quality_floor.h"
#include "core/strategy/run.h"
#include "gui/document/jobs/body_drag.h"

/// Why a body did not get where it was to go, in whole sentences for the banner over the mesh.
namespace winslow::gui {

/// "Blocked by "main" after 41.2 % of the drag: the body is where it got to." drag: at its limit.
std::string end_of_drag(const BodyDrag& drag);

/// How a motion is to be judged that is not all that was asked for.
struct MotionEnd {
  const SmoothResult& smooth;
  double reached;             ///< share of the motion, 0 to 1
  const QualityFloor& floor;  ///< the limits that it had
  const Mesh& mesh;           ///< where it ended
};
/// "Blocked by "main" after 41.2 % of the motion: the body is where it got to." Of limits of the
/// quality also what the mesh comes to by them.
std::string end_of_motion(const MotionEnd& end);

}  // namespace winslow::gui
