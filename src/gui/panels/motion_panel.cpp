#include "gui/panels/motion_panel.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "core/motion/rigid_motion.h"
#include "gui/panels/forms/option_form.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// The fields of a vector begin where those of numbers do, with their letters before them.
void vector_row(const char* label, const char* tip) {
  ui::row(label, tip, motion_label_share);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() - ui::letter_width());
}

bool moves(const RigidMotion& m) { return m.rotate != 0 || m.translate != Vec2(0, 0); }

bool finite(const RigidMotion& m) {
  return std::isfinite(m.rotate) && m.translate.allFinite() && m.pivot.allFinite();
}

}  // namespace

void MotionPanel::draw(const PanelContext& context) {
  const Session& session = context.session;
  const bool open = ui::section("section/motion", "Move the selection");
  if (!open || session.selection().empty()) {
    if (session.selection().motion_preview()) context.emit(action::PreviewMotion{});
    if (!open) return;
    if (!session.document()) return ui::text_dim("No mesh is open.");
    return ui::text_wrapped(
        "Click a body in the picture, or a marker in the list, to select it. "
        "Then drag it, turn it by its ring, or type numbers here.");
  }
  const bool live = session.dragging();
  ImGui::BeginDisabled(live);
  const bool entered = draw_fields(context, live);
  draw_pivot(context);
  draw_motion_steps(context);
  draw_keep_outside(context);
  draw_quality_limits(context);
  ImGui::EndDisabled();
  typed_.pivot = session.selection().pivot();
  const bool can = !live && moves(typed_) && finite(typed_);
  preview(context, can && !session.in_motion());
  const bool pressed =
      ui::button("motion/apply", "Apply",
                 {"Move the selected bodies and smooth the mesh around them. Enter "
                  "in a field does so as well.",
                  ui::ButtonStyle::primary, can, -1});
  if (!can || !(pressed || entered)) return;
  context.emit(action::PreviewMotion{});
  context.emit(action::ApplyMotion{typed_});
  typed_ = RigidMotion{};
}

/// Draws where the typed motion would put the bodies, or no longer.
void MotionPanel::preview(const PanelContext& context, bool wanted) const {
  const auto& shown = context.session.selection().motion_preview();
  if (wanted && (!shown || shown->motion != RigidMotionRequest(typed_)))
    context.emit(action::PreviewMotion{typed_});
  else if (!wanted && shown)
    context.emit(action::PreviewMotion{});
}

/// True if Enter was pressed in one of them.
bool MotionPanel::draw_fields(const PanelContext& context, bool live) {
  const auto motion = context.session.mesh().live_motion();
  RigidMotion shown = live && motion ? *motion : typed_;
  vector_row("Translate", "How far the body moves, x and y, in units of the mesh.");
  bool entered = false;
  const ui::VectorField translate{"motion/dx", "motion/dy",
                                  "In units of the mesh. Enter applies the motion."};
  bool changed = ui::vector_field(translate, shown.translate, &entered);
  ui::row("Rotate", "Degrees about the pivot, counter-clockwise positive.", motion_label_share);
  changed |= ui::number("motion/rotate", shown.rotate,
                        "Degrees about the pivot, counter-clockwise positive. Enter applies the "
                        "motion.",
                        "%.6g\xC2\xB0");
  entered |= ui::entered();
  if (changed && !live) typed_ = shown;
  return entered;
}

void MotionPanel::draw_pivot(const PanelContext& context) {
  Vec2 pivot = context.session.selection().pivot();
  vector_row("Pivot", "The point about which the body turns. Drag it in the picture, or type it.");
  const ui::VectorField field{"motion/pivot_x", "motion/pivot_y",
                              "The point about which the body turns."};
  if (ui::vector_field(field, pivot) && pivot.allFinite())
    context.emit(action::SetPivot{pivot, {}});
  constexpr std::array<PivotPlace, 4> places{PivotPlace::centre, PivotPlace::centroid,
                                             PivotPlace::leading_edge, PivotPlace::trailing_edge};
  constexpr const char* tip =
      "Where the pivot is: the centre of the bounding box, the centroid of the enclosed area, the "
      "sharper end of the longest chord (trailing edge) or its other end (leading edge). Ctrl "
      "snaps to these and to nodes while the pivot is dragged in the picture.";
  ui::row("Pivot at", tip, motion_label_share);
  std::vector<std::string> names{"Centre", "Centroid", "Leading edge", "Trailing edge"};
  std::size_t chosen = names.size();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (context.session.selection().pivot_place() == places[i]) chosen = i;
  if (chosen == names.size()) names.emplace_back("As typed or dragged");
  if (ui::combo("motion/pivot_place", names, chosen, tip) && chosen < places.size())
    context.emit(action::SetPivot{{}, places[chosen]});
}

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

void draw_motion_steps(const PanelContext& context) {
  constexpr std::array<int, 4> increments{0, 1, 8, 32};
  const std::vector<std::string> names{"Automatic", "At once", "8 steps", "32 steps"};
  const MotionOptions& now = context.session.jobs().motion_options();
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < increments.size(); ++i)
    if (increments[i] == now.increments) chosen = i;
  constexpr const char* tip =
      "In how many steps the body goes to its place, the mesh smoothed after each. Automatic: at "
      "once, and in steps only if that leaves the mesh tangled.";
  ui::row("Steps", tip, motion_label_share);
  if (ui::combo("motion/steps", names, chosen, tip)) {
    MotionOptions options = now;
    options.increments = increments[chosen];
    context.emit(action::EditMotionOptions{difference(now, options)});
  }
}

void draw_quality_limits(const PanelContext& context) {
  const Jobs& jobs = context.session.jobs();
  MotionOptions options = jobs.motion_options();
  if (ui::quality_limits_form("motion", options.floor, context.session.in_space() ? 3 : 2,
                              follows_path(options, jobs.smooth_options())))
    context.emit(action::EditMotionOptions{difference(jobs.motion_options(), options)});
}

}  // namespace winslow::gui
