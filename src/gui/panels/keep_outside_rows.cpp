#include "gui/panels/keep_outside_rows.h"

#include <cstddef>
#include <string>
#include <type_traits>
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

std::vector<Index> selected_nodes(const Session& session) {
  std::vector<std::string> names;
  for (const Index marker : session.selection().markers())
    names.push_back(session.topology()->markers()[at(marker)].name);
  return session.topology()->markers().nodes_of(names);
}

/// A circle about a body, in space a sphere, or a box, to begin with: room for the body to turn,
/// and as much again around it.
template <class Box>
KeepOutside around(Shape shape, const Box& body) {
  KeepOutside keep;
  const auto centre = body_centre(body);
  using Point = std::decay_t<decltype(centre)>;
  const double room = body.size().norm();
  const Point low = centre - Point::Constant(room), high = centre + Point::Constant(room);
  if (shape == circle) {
    keep.radius = room;
    keep.centre = centre.template head<2>();  // smoothing in place has no body to ask for it
  }
  if (shape == box) {
    keep.corner = low.template head<2>();
    keep.opposite = high.template head<2>();
  }
  if constexpr (Point::SizeAtCompileTime == 3) {
    if (shape == circle) keep.centre_z = centre.z();
    if (shape == box) {
      keep.corner_z = low.z();
      keep.opposite_z = high.z();
    }
  }
  return keep;
}

KeepOutside first(Shape shape, const Session& session) {
  const std::vector<Index> nodes = selected_nodes(session);
  return session.in_space() ? around(shape, space_bounds(session.coordinates(), nodes))
                            : around(shape, bounds(session.coordinates(), nodes));
}

}  // namespace

void draw_keep_outside(const PanelContext& context) {
  const Session& session = context.session;
  const bool space = session.in_space();
  const std::string tip =
      std::string("Nodes outside a ") + (space ? "sphere" : "circle") +
      " about the body, or outside a box, stay where they are, bit by bit. The region is drawn in "
      "the picture. A body that moves far needs a large one.";
  SmoothOptions options = session.jobs().smooth_options();
  KeepOutside& keep = options.keep_outside;
  auto chosen = static_cast<std::size_t>(shape_of(keep));
  ui::row("Keep outside", tip, motion_label_share);
  bool changed = ui::combo("motion/keep_outside", {"Nothing", space ? "Sphere" : "Circle", "Box"},
                           chosen, tip);
  if (changed) keep = first(static_cast<Shape>(chosen), session);
  changed |= ui::option_form("motion/region", option_table(keep));
  if (changed)
    context.emit(action::EditSmoothOptions{difference(session.jobs().smooth_options(), options)});
}

}  // namespace winslow::gui
