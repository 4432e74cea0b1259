#include "gui/document/jobs/end_text.h"

#include "gui/base/text.h"
#include "gui/document/jobs/drag_text.h"

namespace winslow::gui {

namespace {

constexpr const char* got_to = ": the body is where it got to";

std::string share_text(double share, const char* of) {
  return short_number(100 * share) + " % of the " + of;
}

/// What each metric with a limit has come to: " Worst elements now: Normalized Jacobian 0.512."
std::string worst_values(const QualityFloor& floor, const Mesh& mesh) {
  std::string text;
  for (std::size_t m = 0; m < floor.limits.size(); ++m) {
    if (!floor.limits[m]) continue;
    const Metric metric = limited_metrics()[m];
    const double worst = element_value(mesh, worst_element(mesh, metric), metric);
    text += (text.empty() ? " Worst elements now: " : ", ") + std::string(metric_label(metric)) +
            ' ' + short_number(worst);
  }
  return text.empty() ? text : text + '.';
}

/// The motion ended before a limit of the quality.
std::string end_at_limit(const MotionEnd& end) {
  const std::string& limit = end.smooth.limited_by;
  std::string text = limit;
  if (end.reached >= 1)
    text += " if it were smoothed to the end: the mesh is the last one within the limit.";
  else if (end.reached <= 0)
    text += " at once: the body has not moved.";
  else
    text += " beyond " + share_text(end.reached, "motion") + got_to + '.';
  return text + worst_values(end.floor, end.mesh);
}

}  // namespace

std::string end_of_drag(const BodyDrag& drag) {
  return blocked_text(drag) + (drag.frame().contact ? " after " : " beyond ") +
         share_text(drag.frame().share, "drag") + got_to + '.';
}

std::string end_of_motion(const MotionEnd& end) {
  const SmoothResult& smooth = end.smooth;
  if (!smooth.contact && !smooth.limited_by.empty()) return end_at_limit(end);
  std::string text = "No valid mesh was found beyond ";
  if (smooth.contact)
    text = blocked_text(smooth.contact->edges) + " after ";
  else if (smooth.out_of_iterations)
    text = "The limit of iterations was reached after ";
  text += share_text(end.reached, "motion") + got_to;
  if (smooth.gap) text += ", " + describe(*smooth.gap);
  return text + '.';
}

}  // namespace winslow::gui
