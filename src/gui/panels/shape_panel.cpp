#include "gui/panels/shape_panel.h"

#include <cmath>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr float label_share = 0.38f;

bool sensible(const SineDeformation& s) {
  return std::isfinite(s.amplitude) && s.amplitude != 0 && std::isfinite(s.waves) &&
         s.direction.allFinite() && s.direction.norm() > 0;
}

const char* chosen_arc(const ShapeEdit& edit) {
  if (!edit.arc) return "Drag a boundary node. Shift+click takes the arc up to another one.";
  return edit.arc->first == edit.arc->last ? "One node is held. Drag it in the picture."
                                           : "An arc is held. Drag any of its nodes.";
}

}  // namespace

void ShapePanel::draw(const PanelContext& context) {
  if (!ui::section("section/shape", "Change the shape")) {
    if (context.session.selection().deformation_preview())
      context.emit(action::PreviewDeformation{});
    return;
  }
  if (!context.session.document()) {
    ui::text_dim("No mesh is open.");
    return;
  }
  ImGui::BeginDisabled(context.session.dragging());
  draw_by_hand(context);
  draw_sine(context);
  ImGui::EndDisabled();
}

void ShapePanel::draw_by_hand(const PanelContext& context) {
  const ShapeEdit& edit = context.session.selection().shape_edit();
  bool active = edit.active;
  if (ui::checkbox("shape/edit", "Edit boundary nodes (E)", active,
                   "Drag single nodes or arcs of a boundary instead of whole bodies."))
    context.emit(action::SetShapeEdit{active, edit.radius});
  if (!edit.active) return;
  double radius = edit.radius;
  constexpr const char* tip =
      "How far along the boundary a drag fades out, in units of the mesh; 0 moves the held nodes "
      "alone. The wheel changes it during a drag.";
  ui::row("Falloff", tip, label_share);
  if (ui::number("shape/radius", radius, tip) && std::isfinite(radius))
    context.emit(action::SetShapeEdit{true, std::max(radius, 0.0)});
  ui::text_wrapped(chosen_arc(edit));
}

void ShapePanel::draw_sine(const PanelContext& context) {
  const Session& session = context.session;
  ui::text_dim("Sine along the selected body");
  if (session.selection().empty()) {
    ui::text_wrapped("Select a body first.");
    return;
  }
  draw_fields();
  ui::checkbox("shape/preview", "Preview", preview_,
               "Draw where the boundary would be, before anything is done.");
  const auto& shown = session.selection().deformation_preview();
  const bool wanted = preview_ && sensible(typed_) && !session.in_motion();
  if (wanted && (!shown || shown->shape != typed_))
    context.emit(action::PreviewDeformation{typed_});
  else if (!wanted && shown)
    context.emit(action::PreviewDeformation{});
  if (ui::button("shape/apply", "Apply",
                 {"Deform the selected bodies and smooth the mesh around them.",
                  ui::ButtonStyle::primary, sensible(typed_) && !session.in_motion(), -1})) {
    context.emit(action::ApplyDeformation{typed_});
    typed_.amplitude = 0;
  }
}

bool ShapePanel::draw_fields() {
  bool changed = false;
  const auto field = [&](const char* id, const char* label, double& value, const char* tip) {
    ui::row(label, tip, label_share);
    changed |= ui::number(id, value, tip);
  };
  field("shape/amplitude", "Amplitude", typed_.amplitude,
        "Largest displacement, in units of the mesh; negative turns the sine over.");
  field("shape/waves", "Waves", typed_.waves, "Full periods over the length of the body.");
  constexpr const char* direction_tip =
      "Which way the boundary is displaced; the sine runs along the body at right angles to it.";
  ui::row("Direction", direction_tip, label_share);
  std::size_t direction = typed_.direction == Vec2(1, 0) ? 1 : 0;
  if (ui::combo("shape/direction", {"y", "x"}, direction, direction_tip)) {
    typed_.direction = direction == 1 ? Vec2(1, 0) : Vec2(0, 1);
    changed = true;
  }
  constexpr const char* fade_tip =
      "Where the displacement fades to nothing, so that an edge stays where it is. Start and end "
      "are those of smallest and largest x (for direction y).";
  ui::row("Fade", fade_tip, label_share);
  auto fade = static_cast<std::size_t>(typed_.fade);
  if (ui::combo("shape/fade", {"None", "At the start", "At the end", "At both ends"}, fade,
                fade_tip)) {
    typed_.fade = static_cast<Fade>(fade);
    changed = true;
  }
  if (typed_.fade != Fade::none)
    field("shape/fade_length", "Fade length", typed_.fade_length,
          "Share of the body's length over which it fades, up to 0.5.");
  return changed;
}

}  // namespace winslow::gui
