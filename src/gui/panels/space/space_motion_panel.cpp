#include "gui/panels/space/space_motion_panel.h"

#include <array>
#include <cmath>
#include <string>

#include "gui/panels/motion_panel.h"
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
          "Click a body in the picture, or a marker in the list, to select it. Then drag its "
          "handle, "
          "or type numbers here.");
    return;
  }
  const bool live = session.dragging();
  typed_.pivot = session.selection().space_pivot();
  typed_.axis = session.selection().space().axis();
  ImGui::BeginDisabled(live);
  const bool entered = draw_fields(context, live);
  draw_pivot(context);
  draw_motion_steps(context);
  ImGui::EndDisabled();
  const bool can = !live && moves(typed_) && usable(typed_);
  preview(context, can && !session.in_motion());
  const bool pressed =
      ui::button("motion/apply", "Apply",
                 {"Move the selected bodies and smooth the mesh around them. Enter in a field does "
                  "so as well.",
                  ui::ButtonStyle::primary, can, -1});
  // Below the button, which a small window is to show.
  ImGui::BeginDisabled(live);
  draw_keep_outside(context);
  draw_quality_limits(context);
  ImGui::EndDisabled();
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

/// True if Enter was pressed in one of them. live: they show the drag under the mouse.
bool SpaceMotionPanel::draw_fields(const PanelContext& context, bool live) {
  const auto motion = live_space_motion(context.session.mesh());
  SpaceMotion shown = live && motion ? *motion : typed_;
  bool entered = false;
  ui::text_dim("Translate");
  ui::tooltip("How far the body moves, x, y and z, in units of the mesh.");
  bool changed = ui::space_vector_field(
      {"motion/d", "how far the body moves. Enter applies the motion."}, shown.translate, &entered);
  constexpr const char* tip =
      "Degrees about the axis through the pivot, counter-clockwise seen from where the axis points "
      "to. Enter applies the motion.";
  ui::row("Rotate", tip, motion_label_share);
  changed |= ui::number("motion/rotate", shown.rotate, tip, "%.6g\xC2\xB0");
  entered |= ui::entered();
  if (changed && !live) typed_ = shown;
  return entered;
}

/// Where the axis is, and where it comes from.
void SpaceMotionPanel::draw_pivot(const PanelContext& context) {
  const Selection& selection = context.session.selection();
  draw_sources(context);
  Vec3 axis = selection.space().axis();
  constexpr const char* tip = "The axis about which the body turns: x, y, z, or any other.";
  ui::row("Axis", tip, motion_label_share);
  std::vector<std::string> names{"x", "y", "z"};
  std::size_t chosen = 3;
  for (Index k = 0; k < 3; ++k)
    if (axis == Vec3::Unit(k)) chosen = static_cast<std::size_t>(k);
  if (chosen == 3) names.emplace_back("Another one");
  if (ui::combo("motion/axis", names, chosen, tip) && chosen < 3)
    context.emit(action::SetSpaceAxis{Vec3::Unit(static_cast<Index>(chosen))});
  if (ui::space_vector_field({"motion/axis", "the direction of the axis, of any length but 0."},
                             axis))
    context.emit(action::SetSpaceAxis{axis});
  Vec3 pivot = selection.space_pivot();
  ui::row("Pivot", "A point of the axis about which the body turns.", motion_label_share);
  const bool elsewhere = selection.space().source().from != PivotFrom::centre;
  if (ui::button("motion/pivot_centre", elsewhere ? "To the centre" : "At the centre",
                 {"The centre of the bounding box of what is selected.", ui::ButtonStyle::normal,
                  elsewhere, -1}))
    context.emit(action::SetSpacePivot{});
  if (ui::space_vector_field({"motion/pivot", "a point of the axis."}, pivot) && pivot.allFinite())
    context.emit(action::SetSpacePivot{pivot});
}

/// Buttons that let the next click in the picture pick pivot and axis.
void SpaceMotionPanel::draw_sources(const PanelContext& context) {
  struct Source {
    PivotFrom from;
    const char *id, *label, *tip;
  };
  static constexpr std::array<Source, 4> sources{
      {{PivotFrom::edge, "motion/pick_edge", "Edge",
        "Click an edge in the picture: the body turns about it, as about a hinge. A row of sharp "
        "edges that goes on straight is taken as one."},
       {PivotFrom::nodes, "motion/pick_nodes", "2 nodes",
        "Click two nodes in the picture: the body turns about the line through both."},
       {PivotFrom::face, "motion/pick_face", "Face",
        "Click a face in the picture: the body turns about its normal, through its centre."},
       {PivotFrom::node, "motion/pick_node", "Node",
        "Click a node in the picture: it is the pivot. The axis keeps its direction."}}};
  ui::text_dim("Turn about, picked in the picture");
  ui::tooltip("Choose one, then click in the picture. Esc ends it.");
  const auto& pick = context.session.selection().space().pick();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float room = ImGui::GetContentRegionAvail().x - 3 * gap;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const auto& [from, id, label, tip] = sources[k];
    const float width = room * (from == PivotFrom::nodes ? 0.325f : 0.225f);
    if (k > 0) ImGui::SameLine();
    const bool armed = pick && pick->from == from;
    if (ui::button(id, label,
                   {tip, armed ? ui::ButtonStyle::primary : ui::ButtonStyle::normal, true, width}))
      context.emit(action::PickPivot{armed ? std::nullopt : std::optional(from)});
  }
}

}  // namespace winslow::gui
