#include "gui/panels/space/space_motion_panel.h"

#include <array>
#include <cmath>
#include <string>

#include "gui/panels/forms/motion_steps_row.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

bool moves(const SpaceMotion& m) { return m.rotate != 0 || m.translate != Vec3(0, 0, 0); }

bool usable(const SpaceMotion& m) {
  return std::isfinite(m.rotate) && m.translate.allFinite() && m.pivot.allFinite() &&
         m.axis.allFinite() && m.axis.norm() > 0;
}

}  // namespace

void SpaceMotionPanel::draw(const PanelContext& context) {
  const Session& session = context.session;
  const bool open = ui::section("section/motion", "Move the selection");
  if (!open || session.selection().empty()) {
    if (session.selection().motion_preview()) context.emit(action::PreviewMotion{});
    if (open)
      ui::text_wrapped(
          "Click a body in the picture, or a marker in the list, to select it. Then type numbers "
          "here.");
    return;
  }
  const bool entered = draw_fields();
  draw_axis();
  draw_pivot(context);
  draw_motion_steps(context);
  typed_.pivot = session.selection().space_pivot();
  const bool can = moves(typed_) && usable(typed_);
  preview(context, can && !session.in_motion());
  const bool pressed =
      ui::button("motion/apply", "Apply",
                 {"Move the selected bodies and smooth the mesh around them. Enter in a field does "
                  "so as well.",
                  ui::ButtonStyle::primary, can, -1});
  if (!can || !(pressed || entered)) return;
  context.emit(action::PreviewMotion{});
  context.emit(action::ApplyMotion{typed_});
  typed_.rotate = 0;
  typed_.translate.setZero();
}

/// Draws where the typed motion would put the bodies, or no longer.
void SpaceMotionPanel::preview(const PanelContext& context, bool wanted) const {
  const auto& shown = context.session.selection().motion_preview();
  if (wanted && (!shown || shown->motion != RigidMotionRequest(typed_)))
    context.emit(action::PreviewMotion{typed_});
  else if (!wanted && shown)
    context.emit(action::PreviewMotion{});
}

/// True if Enter was pressed in one of them.
bool SpaceMotionPanel::draw_fields() {
  bool entered = false;
  ui::text_dim("Translate");
  ui::tooltip("How far the body moves, x, y and z, in units of the mesh.");
  ui::space_vector_field({"motion/d", "how far the body moves. Enter applies the motion."},
                         typed_.translate, &entered);
  constexpr const char* tip =
      "Degrees about the axis through the pivot, counter-clockwise seen from where the axis points "
      "to. Enter applies the motion.";
  ui::row("Rotate", tip, motion_label_share);
  ui::number("motion/rotate", typed_.rotate, tip, "%.6g\xC2\xB0");
  return entered || ui::entered();
}

void SpaceMotionPanel::draw_axis() {
  constexpr const char* tip = "The axis about which the body turns: x, y, z, or any other.";
  ui::row("Axis", tip, motion_label_share);
  std::vector<std::string> names{"x", "y", "z"};
  std::size_t chosen = 3;
  for (Index k = 0; k < 3; ++k)
    if (typed_.axis == Vec3::Unit(k)) chosen = static_cast<std::size_t>(k);
  names.emplace_back("As typed");
  if (ui::combo("motion/axis", names, chosen, tip) && chosen < 3)
    typed_.axis = Vec3::Unit(static_cast<Index>(chosen));
  ui::space_vector_field({"motion/axis", "the direction of the axis, of any length but 0."},
                         typed_.axis);
}

void SpaceMotionPanel::draw_pivot(const PanelContext& context) {
  Vec3 pivot = context.session.selection().space_pivot();
  const bool typed = context.session.selection().space_pivot_typed();
  ui::row("Pivot", "A point of the axis about which the body turns.", motion_label_share);
  if (ui::button("motion/pivot_centre", typed ? "To the centre" : "At the centre",
                 {"The centre of the bounding box of what is selected.", ui::ButtonStyle::normal,
                  typed, -1}))
    context.emit(action::SetSpacePivot{});
  if (ui::space_vector_field({"motion/pivot", "a point of the axis."}, pivot) && pivot.allFinite())
    context.emit(action::SetSpacePivot{pivot});
}

}  // namespace winslow::gui
