#include "gui/panels/panels.h"

#include "core/motion/rigid_motion.h"
#include "gui/base/text.h"
#include "gui/panels/forms/option_form.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// The labels' share of a row.
constexpr float motion_label_share = 0.385f;

/// Aligns the fields of a vector with those of numbers; their letters are left of them.
void vector_row(const char* label, const char* tip) {
  ui::row(label, tip, motion_label_share);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() - ui::letter_width());
}

/// Fields for the translation in the plane. True if Enter was pressed in one of them.
bool plane_translation(Vec3& translate) {
  vector_row("Translate", "How far the body moves, x and y, in units of the mesh.");
  Vec2 in_plane = translate.head<2>();
  bool entered = false;
  ui::vector_field({"motion/dx", "motion/dy", "In units of the mesh. Enter applies the motion."},
                   in_plane, &entered);
  translate = Vec3(in_plane.x(), in_plane.y(), 0);
  return entered;
}

/// The same in space, below the label, since three fields do not fit beside it.
bool space_translation(Vec3& translate) {
  ui::text_dim("Translate");
  ui::tooltip("How far the body moves, x, y and z, in units of the mesh.");
  bool entered = false;
  ui::space_vector_field({"motion/d", "how far the body moves. Enter applies the motion."},
                         translate, &entered);
  return entered;
}

bool sound(const RigidMotion& m) {
  const Vec3 axis = axis_of(m);
  return std::isfinite(m.rotate) && m.translate.allFinite() && pivot_of(m).allFinite() &&
         axis.allFinite() && axis.norm() > 0;
}
bool usable(const RigidMotion& m) { return moves(m) && sound(m); }

/// Draws buttons that make the next click in the picture pick pivot and axis.
void draw_sources(const PanelContext& context) {
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

/// Draws the pivot in the plane: the point and the named places.
void draw_pivot(const PanelContext& context) {
  Vec2 pivot = context.session.selection().pivot();
  vector_row("Pivot", "The point about which the body turns. Drag it in the picture, or type it.");
  const ui::VectorField field{"motion/pivot_x", "motion/pivot_y",
                              "The point about which the body turns."};
  if (ui::vector_field(field, pivot) && pivot.allFinite())
    context.emit(action::SetPivot{pivot, {}});
  constexpr std::array<PivotPlace, 4> places{PivotPlace::centre, PivotPlace::centroid,
                                             PivotPlace::leading_edge, PivotPlace::trailing_edge};
  constexpr const char* tip =
      "Where the pivot is: the centre of the bounding box, the centroid of the enclosed area, "
      "the sharper end of the longest chord (trailing edge) or its other end (leading edge). "
      "Ctrl snaps to these and to nodes while the pivot is dragged in the picture.";
  std::vector<std::string> names{"Centre", "Centroid", "Leading edge", "Trailing edge"};
  std::size_t chosen = names.size();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (context.session.selection().pivot_place() == places[i]) chosen = i;
  if (chosen == names.size()) names.emplace_back("As typed or dragged");
  if (ui::choice("motion/pivot_place", "Pivot at", names, chosen, tip, motion_label_share) &&
      chosen < places.size())
    context.emit(action::SetPivot{{}, places[chosen]});
}

/// Draws pivot and axis in space, and their source.
void draw_axis_and_pivot(const PanelContext& context) {
  const Selection& selection = context.session.selection();
  draw_sources(context);
  Vec3 axis = selection.space().axis();
  std::vector<std::string> names{"x", "y", "z"};
  std::size_t chosen = 3;
  for (Index k = 0; k < 3; ++k)
    if (axis == Vec3::Unit(k)) chosen = static_cast<std::size_t>(k);
  if (chosen == 3) names.emplace_back("Another one");
  if (ui::choice("motion/axis", "Axis", names, chosen,
                 "The axis about which the body turns: x, y, z, or any other.",
                 motion_label_share) &&
      chosen < 3)
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

/// The parts of the panel that differ between the plane and space.
struct MotionForm {
  bool (*draw_translation)(Vec3&);
  void (*draw_pivot)(const PanelContext&);
  const char *turns_about, *round_label, *round;
  bool in_plane;
};
constexpr MotionForm plane_form{plane_translation, draw_pivot, "pivot, counter-clockwise positive.",
                                "Circle",          "circle",   true};
constexpr MotionForm space_form{
    space_translation,
    draw_axis_and_pivot,
    "axis through the pivot, counter-clockwise seen from where the axis points to.",
    "Sphere",
    "sphere",
    false};
const MotionForm& form_for(const Session& session) {
  return session.in_space() ? space_form : plane_form;
}

enum Shape : std::size_t { no_region, ball_region, box_region };

Shape shape_of(const KeepOutside& keep) {
  if (keep.radius) return ball_region;
  return keep.corner ? box_region : no_region;
}

/// Initial region around a body, a circle (in space a sphere) or a box: twice the room that the
/// body needs to rotate.
KeepOutside around(Shape shape, const Coordinates& x, const std::vector<Index>& nodes) {
  KeepOutside keep;
  const Box<3> body = body_box(x, nodes);
  const Vec3 centre = body_centre(body);
  const double room = body.size().norm();
  const auto place = [&](const Vec3& p) { return GivenVector::of(x.dimension(), p); };
  if (shape == ball_region) {
    keep.radius = room;
    keep.centre = place(centre);  // smoothing without a motion has no body that defines it
  }
  if (shape == box_region) {
    keep.corner = place(centre - Vec3::Constant(room));
    keep.opposite = place(centre + Vec3::Constant(room));
  }
  return keep;
}

KeepOutside first(Shape shape, const LiveMesh& mesh, const Selection& selection) {
  return around(shape, mesh.coordinates(), mesh.topology()->markers().nodes_of(selection.names()));
}

/// Rows for the region outside which nothing moves (SmoothOptions::keep_outside): none, a circle
/// about the selection (of a volume mesh a sphere), a box around it.
void draw_keep_outside(const PanelContext& context) {
  const Session& session = context.session;
  const MotionForm& form = form_for(session);
  SmoothOptions options = session.solver_settings().smooth_options();
  KeepOutside& keep = options.keep_outside;
  auto chosen = static_cast<std::size_t>(shape_of(keep));
  bool changed = ui::choice(
      "motion/keep_outside", "Keep outside", {"Nothing", form.round_label, "Box"}, chosen,
      "Nodes outside a " + std::string(form.round) +
          " about the body, or outside a box, stay where they are, bit by bit. The region is drawn "
          "in the picture. A body that moves far needs a large one.",
      motion_label_share);
  if (changed) keep = first(static_cast<Shape>(chosen), session.mesh(), session.selection());
  changed |= ui::option_form("motion/region", option_table(keep));
  if (changed) context.edit(options);
}

/// Draws the choice of the number of motion steps.
void draw_motion_steps(const PanelContext& context) {
  static constexpr std::array<ui::Named<int>, 4> steps{
      {{0, "Automatic"}, {1, "At once"}, {8, "8 steps"}, {32, "32 steps"}}};
  MotionOptions options = context.session.solver_settings().motion_options();
  if (ui::choice("motion/steps", "Steps", steps, options.increments,
                 "In how many steps the body goes to its place, the mesh smoothed after each. "
                 "Automatic: through valid meshes, in steps as long as they can be; by the fixed "
                 "point at once, and in steps only if that leaves the mesh tangled.",
                 motion_label_share))
    context.edit(options);
}

/// Draws the quality limits, which apply to all further motions and deformations, dragged or typed.
void draw_quality_limits(const PanelContext& context) {
  const SolverSettings& solver = context.session.solver_settings();
  MotionOptions options = solver.motion_options();
  if (ui::quality_limits_form("motion", options.floor, cell_dimension_of(context.session.kind()),
                              follows_path(options, solver.smooth_options())))
    context.edit(options);
}

/// Where the mesh came from whose shapes motions keep: "as opened", "as smoothed (step 3)".
std::string origin_of_reference(const History& history) {
  const std::size_t step = history.reference_position();
  if (step == 0) return "as opened";
  const std::string number = " (step " + std::to_string(step) + ")";
  const Command& command = history.command(step);
  if (std::holds_alternative<LayersCommand>(command)) return "as the layers left it" + number;
  if (std::holds_alternative<EditVcvCommand>(command)) return "as edited VCVs left it" + number;
  return "as smoothed" + number;
}

void draw_reference(const PanelContext& context) {
  const std::string text = reference_text(context.session);
  if (text.empty()) return;
  ui::text_wrapped(text, palette().text_dim);
  ui::note("motion/reference");
  ui::tooltip(
      "Motions keep the shapes that the elements have in this mesh, however many motions there "
      "are: "
      "the mesh depends on where the bodies are, not on the way there. Smoothing, layers and "
      "edited "
      "control volumes make the mesh that they lead to the next one to keep; motions do not. Undo "
      "goes back to the one before. The tab History numbers the steps.");
}

/// True if the pivot is where commands without one have it, in the centre of what moves.
bool turns_about_centre(const Session& session) {
  const Selection& selection = session.selection();
  return session.in_space() ? selection.space().source().from == PivotFrom::centre
                            : selection.pivot_place() == PivotPlace::centre;
}

/// Puts the selection's pivot and axis where a listed motion has them.
void take_pivot(const PanelContext& context, const RigidMotion& motion) {
  const Session& session = context.session;
  const Selection& selection = session.selection();
  const bool moved = motion.pivot.has_value() == turns_about_centre(session) ||
                     (motion.pivot && Vec3(*motion.pivot) != selection.space_pivot());
  if (session.in_space()) {
    if (axis_of(motion) != selection.space().axis())
      context.emit(action::SetSpaceAxis{axis_of(motion)});
    if (moved)
      context.emit(
          action::SetSpacePivot{motion.pivot ? std::optional<Vec3>(*motion.pivot) : std::nullopt});
  } else if (moved) {
    context.emit(action::SetPivot{
        motion.pivot ? std::optional<Vec2>(motion.pivot->head<2>()) : std::nullopt, {}});
  }
}

/// Moves the selected bodies by numbers, alone or together with others, and shows the numbers of a
/// drag.
class MotionPanel {
 public:
  void draw(const PanelContext& context) {
    const Session& session = context.session;
    const bool open = ui::section("section/motion", "Move the selection");
    const bool selected = !session.selection().empty();
    if ((!open || !selected) && session.selection().motion_preview())
      context.emit(action::PreviewMotion{});
    if (!open) return;
    if (!session.document()) return ui::text_dim("No mesh is open.");
    if (selected) {
      draw_selected(context);
    } else {
      shown_.clear();
      ui::text_wrapped(session.selection().plan().empty()
                           ? "Click a body in the picture, or a marker in the list, to select it. "
                             "Then drag its handle, or type numbers here."
                           : "Select a body of the list to change its motion, or another one to "
                             "add it.");
    }
    draw_body_list(context);
    if (selected || !session.selection().plan().empty()) draw_reference(context);
    if (!selected) return;
    // Below the buttons, so that the buttons are visible in a small window.
    ImGui::BeginDisabled(session.dragging());
    draw_keep_outside(context);
    draw_quality_limits(context);
    ImGui::EndDisabled();
  }

 private:
  void draw_selected(const PanelContext& context) {
    const Session& session = context.session;
    const bool live = session.dragging();
    const bool loads = follow_list(context);
    draw_heading(context);
    ImGui::BeginDisabled(live);
    const bool entered = draw_fields(context, live);
    form_for(session).draw_pivot(context);
    draw_motion_steps(context);
    ImGui::EndDisabled();
    const RigidMotion motion = asked(session);
    if (!shown_.empty()) {
      preview(context, false);
      if (!loads && !live && !session.in_motion()) keep_listed(context);
      return;
    }
    const bool can = !live && usable(motion);
    preview(context, can && !session.in_motion());
    const bool pressed = ui::button("motion/apply", "Apply",
                                    {"Move the selected bodies and smooth the mesh around them. "
                                     "Enter in a field does so as well.",
                                     ui::ButtonStyle::primary, can, -1});
    draw_add(context, !live && !session.in_motion());
    if (!can || !(pressed || entered)) return;
    context.emit(action::PreviewMotion{});
    context.emit(action::ApplyMotion{motion});
    clear_fields();
  }

  /// Shows the listed motion of what is selected, if there is one. True in the frame in which the
  /// fields take it over.
  bool follow_list(const PanelContext& context) {
    const Selection& selection = context.session.selection();
    const std::vector<std::string> names = selection.names();
    const RigidMotion* listed = selection.plan().find(names);
    if (!listed) {
      if (!shown_.empty()) clear_fields();
      shown_.clear();
      return false;
    }
    if (shown_ == names) return false;
    shown_ = names;
    rotate_ = listed->rotate;
    translate_ = listed->translate;
    take_pivot(context, *listed);
    return true;
  }

  /// While there is a list, says whose motion the fields show.
  void draw_heading(const PanelContext& context) const {
    if (context.session.selection().plan().empty()) return;
    const std::string of = joined(context.session.selection().names());
    ui::text_dim(ui::elided(shown_.empty() ? of + ": not in the list yet" : "Motion of " + of,
                            ImGui::GetContentRegionAvail().x));
    ui::note("motion/motion_of");
    ui::tooltip(of);
  }

  /// The motion of the fields as it is listed: without a pivot in the centre.
  RigidMotion listed_motion(const Session& session) const {
    RigidMotion motion = asked(session);
    if (turns_about_centre(session)) motion.pivot.reset();
    return motion;
  }

  /// Gives the listed body the motion of the fields.
  void keep_listed(const PanelContext& context) const {
    const RigidMotion motion = listed_motion(context.session);
    const RigidMotion* listed = context.session.selection().plan().find(shown_);
    if (listed && *listed != motion && sound(motion)) context.emit(action::PlanBody{motion});
  }

  void draw_add(const PanelContext& context, bool free) {
    const std::vector<std::string> names = context.session.selection().names();
    const std::string of = joined(names);
    const float width = ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().FramePadding.x;
    const RigidMotion motion = listed_motion(context.session);
    const char* list = context.session.selection().plan().empty() ? " to a list" : " to the list";
    if (!ui::button("motion/add_body", ui::elided("Add " + of + list, width),
                    {"Keep this motion for " + of +
                         ", then select other bodies and give them others. All bodies of the list "
                         "move together, each along its own arc.",
                     ui::ButtonStyle::normal, free && sound(motion), -1}))
      return;
    context.emit(action::PreviewMotion{});
    context.emit(action::PlanBody{motion});
    shown_ = names;
  }

  void clear_fields() {
    rotate_ = 0;
    translate_.setZero();
  }

  /// True if Enter was pressed in one of the fields. live: they show the active drag.
  bool draw_fields(const PanelContext& context, bool live) {
    const MotionForm& form = form_for(context.session);
    const auto motion = live ? context.session.mesh().live_motion() : std::nullopt;
    double rotate = motion ? motion->rotate : rotate_;
    Vec3 translate = motion ? Vec3(motion->translate) : translate_;
    bool entered = form.draw_translation(translate);
    const std::string tip =
        "Degrees about the " + std::string(form.turns_about) + " Enter applies the motion.";
    ui::row("Rotate", tip, motion_label_share);
    ui::number("motion/rotate", rotate, tip, "%.6g\xC2\xB0");
    entered |= ui::entered();
    if (!live) {
      rotate_ = rotate;
      translate_ = translate;
    }
    return entered;
  }

  RigidMotion asked(const Session& session) const {
    const Selection& selection = session.selection();
    return motion_of(form_for(session).in_plane, rotate_, translate_, selection.space_pivot(),
                     selection.space().axis());
  }

  /// Shows or hides the outline of the bodies after the typed motion.
  void preview(const PanelContext& context, bool wanted) const {
    const auto& shown = context.session.selection().motion_preview();
    if (!wanted) {
      if (shown) context.emit(action::PreviewMotion{});
      return;
    }
    const RigidMotion motion = asked(context.session);
    if (!shown || shown->motion != motion) context.emit(action::PreviewMotion{motion});
  }

  // As typed; pivot and axis are the session's.
  double rotate_ = 0;  // degrees
  Vec3 translate_{0, 0, 0};
  std::vector<std::string> shown_;  // the listed body that the fields show; empty: none
};

}  // namespace

std::string reference_text(const Session& session) {
  const SmoothOptions& options = session.solver_settings().smooth_options();
  if (!session.document() || options.formulation != Formulation::variational) return {};
  const TargetBlend targets = options.targets.or_else(TargetBlend::keeping());
  if (!refers_to_given(targets)) return {};
  return (targets.keep > 0 ? "Motions keep the mesh " : "Targets refer to the mesh ") +
         origin_of_reference(session.document()->history());
}

DrawPanel motion_panel() { return panel_of<MotionPanel>(); }

}  // namespace winslow::gui
