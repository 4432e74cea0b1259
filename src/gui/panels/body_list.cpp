#include "gui/panels/panels.h"

#include "core/motion/rigid_motion.h"
#include "gui/base/text.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/list_rows.h"

namespace winslow::gui {

namespace {

std::string place(const Vec3& point, bool in_space) {
  std::string text = "(" + short_number(point.x()) + ", " + short_number(point.y());
  return text + (in_space ? ", " + short_number(point.z()) : "") + ")";
}

/// Draws the row of a body. False if the body was removed.
bool draw_row(const PanelContext& context, std::size_t number) {
  const MovingBody& body = context.session.selection().plan().bodies()[number];
  const std::string names = joined(body.markers);
  const std::string summary = motion_summary(body.motion, context.session.in_space());
  std::vector<Index> markers = markers_named(*context.topology(), body.markers);
  const ui::RowAnswer answer = ui::draw_list_row(
      {"motion/body/" + std::to_string(number), names, summary,
       names + "\n" + summary + "\nClick to select it and change its motion.",
       "Take this body out of the list.", markers == context.session.selection().markers()},
      context.theme);
  if (answer == ui::RowAnswer::pressed) context.emit(action::SelectMarkers{std::move(markers)});
  if (answer != ui::RowAnswer::removed) return true;
  context.emit(action::UnplanBody{number});
  return false;
}

void draw_buttons(const PanelContext& context, bool free) {
  const BodyPlan& plan = context.session.selection().plan();
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float room = ImGui::GetContentRegionAvail().x - gap;
  if (ui::button(
          "motion/apply_all", "Apply all",
          {"Move the bodies of the list together, each along its own arc, and smooth the "
           "mesh around them: one step of the history.",
           ui::ButtonStyle::primary, free && plan.moves() && plan.fault().empty(), 0.64f * room}))
    context.emit(action::ApplyBodyPlan{});
  ImGui::SameLine(0, gap);
  if (ui::button("motion/clear_bodies", "Clear",
                 {"Empty the list. Nothing moves.", ui::ButtonStyle::normal, true, -1}))
    context.emit(action::ClearBodyPlan{});
}

}  // namespace

std::string motion_summary(const RigidMotion& motion, bool in_space) {
  std::string text;
  if (motion.rotate != 0) {
    text = short_number(motion.rotate) + "\xC2\xB0 about " +
           (motion.pivot ? place(*motion.pivot, in_space) : "its centre");
    if (in_space) text += ", axis " + place(axis_of(motion), true);
  }
  if (motion.translate != Vec3(0, 0, 0))
    text +=
        (text.empty() ? "" : ", ") + std::string("moves by ") + place(motion.translate, in_space);
  return text.empty() ? "stays" : text;
}

void draw_body_list(const PanelContext& context) {
  const BodyPlan& plan = context.session.selection().plan();
  if (plan.empty()) return;
  const bool free = !context.session.in_motion() && !context.session.dragging();
  ui::text_dim("Bodies that move together");
  ui::tooltip(
      "Each by its own motion, all at the same time. Their outlines are drawn where they "
      "are going.");
  ImGui::BeginDisabled(!free);
  ui::draw_list("listed_bodies", plan.bodies().size(), context.theme,
                [&](std::size_t number) { return draw_row(context, number); });
  if (!plan.fault().empty()) {
    ui::text_wrapped("They cannot move together: " + plan.fault(), palette().danger);
    ui::note("motion/bodies_fault");
  }
  draw_buttons(context, free);
  ImGui::EndDisabled();
}

}  // namespace winslow::gui
