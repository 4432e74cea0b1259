#include "gui/panels/motion_panel.h"

#include <array>
#include <cmath>

#include "gui/panels/keep_outside_rows.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

struct Pair {
  const char* id_x;
  const char* id_y;
};

/// Two fields side by side in the rest of the row.
bool vector_fields(const Pair& ids, Vec2& value, std::string_view tip) {
  // Six digits do not tell places apart on a mesh far from the origin.
  const char* format = value.cwiseAbs().maxCoeff() < 1e5 ? "%.6g" : "%.12g";
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  double x = value.x();
  double y = value.y();
  ImGui::SetNextItemWidth(width);
  bool changed = ui::number(ids.id_x, x, tip, format);
  ImGui::SameLine(0, gap);
  ImGui::SetNextItemWidth(width);
  changed |= ui::number(ids.id_y, y, tip, format);
  value = Vec2(x, y);
  return changed;
}

bool moves(const RigidMotion& m) { return m.rotate != 0 || m.translate != Vec2(0, 0); }

bool finite(const RigidMotion& m) {
  return std::isfinite(m.rotate) && m.translate.allFinite() && m.pivot.allFinite();
}

}  // namespace

void MotionPanel::draw(const PanelContext& context) {
  if (!ui::section("section/motion", "Move the selection")) return;
  const Session& session = context.session;
  if (!session.document()) {
    ui::text_dim("No mesh is open.");
    return;
  }
  if (session.selection().empty()) {
    ui::text_wrapped(
        "Click a body in the picture, or a marker in the list, to select it. "
        "Then drag it, turn it by its ring, or type numbers here.");
    return;
  }
  const bool live = session.dragging();
  ImGui::BeginDisabled(live);
  draw_fields(context, live);
  draw_pivot(context);
  draw_steps(context);
  draw_keep_outside(context);
  ImGui::EndDisabled();
  const bool can = !live && moves(typed_) && finite(typed_);
  if (ui::button("motion/apply", "Apply",
                 {"Move the selected bodies and smooth the mesh around them.",
                  ui::ButtonStyle::primary, can, -1})) {
    typed_.pivot = session.selection().pivot();
    context.emit(action::ApplyMotion{typed_});
    typed_ = RigidMotion{};
  }
}

void MotionPanel::draw_fields(const PanelContext& context, bool live) {
  const auto motion = context.session.mesh().live_motion();
  RigidMotion shown = live && motion ? *motion : typed_;
  ui::row("Translate", "How far the body moves, x and y, in units of the mesh.", 0.34f);
  bool changed =
      vector_fields({"motion/dx", "motion/dy"}, shown.translate, "In units of the mesh.");
  ui::row("Rotate", "Degrees about the pivot, counter-clockwise positive.", 0.34f);
  changed |= ui::number("motion/rotate", shown.rotate,
                        "Degrees about the pivot, counter-clockwise positive.", "%.6g\xC2\xB0");
  if (changed && !live) typed_ = shown;
}

void MotionPanel::draw_pivot(const PanelContext& context) {
  Vec2 pivot = context.session.selection().pivot();
  ui::row("Pivot", "The point about which the body turns. Drag it in the picture, or type it.",
          0.34f);
  if (vector_fields({"motion/pivot_x", "motion/pivot_y"}, pivot,
                    "The point about which the body turns.") &&
      pivot.allFinite())
    context.emit(action::SetPivot{pivot, {}});
  constexpr std::array<PivotPlace, 4> places{PivotPlace::centre, PivotPlace::centroid,
                                             PivotPlace::leading_edge, PivotPlace::trailing_edge};
  constexpr const char* tip =
      "Where the pivot is: the centre of the bounding box, the centroid of the enclosed area, the "
      "sharper end of the longest chord (trailing edge) or its other end (leading edge). Ctrl "
      "snaps to these and to nodes while the pivot is dragged in the picture.";
  ui::row("Pivot at", tip, 0.34f);
  std::vector<std::string> names{"Centre", "Centroid", "Leading edge", "Trailing edge"};
  std::size_t chosen = names.size();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (context.session.selection().pivot_place() == places[i]) chosen = i;
  if (chosen == names.size()) names.emplace_back("As typed or dragged");
  if (ui::combo("motion/pivot_place", names, chosen, tip) && chosen < places.size())
    context.emit(action::SetPivot{{}, places[chosen]});
}

void MotionPanel::draw_steps(const PanelContext& context) {
  constexpr std::array<int, 4> increments{0, 1, 8, 32};
  const std::vector<std::string> names{"Automatic", "At once", "8 steps", "32 steps"};
  const MotionOptions& now = context.session.jobs().motion_options();
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < increments.size(); ++i)
    if (increments[i] == now.increments) chosen = i;
  constexpr const char* tip =
      "In how many steps the body goes to its place, the mesh smoothed after each. Automatic: at "
      "once, and in steps only if that leaves the mesh tangled.";
  ui::row("Steps", tip, 0.34f);
  if (ui::combo("motion/steps", names, chosen, tip)) {
    MotionOptions options = now;
    options.increments = increments[chosen];
    context.emit(action::EditMotionOptions{difference(now, options)});
  }
}

}  // namespace winslow::gui
