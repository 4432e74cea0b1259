#include "gui/panels/keep_outside_rows.h"

#include <cstddef>
#include <string>
#include <vector>

#include "core/motion/rigid_motion.h"
#include "gui/panels/forms/option_form.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

enum Shape : std::size_t { nothing, circle, box };

Shape shape_of(const KeepOutside& keep) {
  if (keep.radius) return circle;
  return keep.corner ? box : nothing;
}

Bounds bounds_of_selection(const Session& session) {
  std::vector<Index> nodes;
  for (const Index marker : session.selection().markers())
    for (const Face& face : session.topology()->markers()[static_cast<std::size_t>(marker)].faces)
      nodes.insert(nodes.end(), {face[0], face[1]});
  return bounds(session.coordinates(), nodes);
}

/// One to begin with: room for the body to turn, and as much again around it.
KeepOutside first(Shape shape, const Bounds& body) {
  KeepOutside keep;
  const Vec2 half = 0.5 * body.size();
  const Vec2 centre = body_centre(body);
  if (shape == circle) {
    keep.radius = 2 * half.norm();
    keep.centre = centre;  // smoothing in place has no body to ask for it
  }
  if (shape == box) {
    const Vec2 room = Vec2::Constant(2 * half.norm());
    keep.corner = centre - room;
    keep.opposite = centre + room;
  }
  return keep;
}

}  // namespace

void draw_keep_outside(const PanelContext& context) {
  const Session& session = context.session;
  constexpr const char* tip =
      "Nodes outside a circle about the body, or outside a box, stay where they are, bit by bit. "
      "The region is drawn in the picture. A body that moves far needs a large one.";
  SmoothOptions options = session.jobs().smooth_options();
  KeepOutside& keep = options.keep_outside;
  auto chosen = static_cast<std::size_t>(shape_of(keep));
  ui::row("Keep outside", tip, motion_label_share);
  bool changed = ui::combo("motion/keep_outside", {"Nothing", "Circle", "Box"}, chosen, tip);
  if (changed) keep = first(static_cast<Shape>(chosen), bounds_of_selection(session));
  changed |= ui::option_form("motion/region", option_table(keep));
  if (changed)
    context.emit(action::EditSmoothOptions{difference(session.jobs().smooth_options(), options)});
}

}  // namespace winslow::gui
