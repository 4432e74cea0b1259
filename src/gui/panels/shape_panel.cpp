#include "gui/panels/panels.h"

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr float label_share = 0.38f;

bool sensible(const SineDeformation& s) {
  return std::isfinite(s.amplitude) && s.amplitude != 0 && std::isfinite(s.waves) &&
         s.direction.allFinite() && s.direction.norm() > 0;
}

/// The axis of a sine's direction, 0 to 2.
std::size_t axis_of(const SineDeformation& s) {
  if (s.direction.z() != 0) return 2;
  return s.direction == Vec2(1, 0) ? 0 : 1;
}

/// Sets direction and running axis of a sine. along: needed in space; without it the sine runs at
/// right angles to its direction.
void set_axes(SineDeformation& s, std::size_t direction, std::optional<std::size_t> along) {
  const Vec3 unit = Vec3::Unit(static_cast<Index>(direction));
  s.direction = GivenVector::of(direction == 2 ? 3 : 2, unit);
  s.along = along ? std::optional(Vec3(Vec3::Unit(static_cast<Index>(*along)))) : std::nullopt;
}

std::string chosen_patch(const ShapeEdit& edit) {
  if (!edit.patch)
    return "Drag a node of the surface, or click nodes and faces to hold them (Shift adds). A drag "
           "fades over their marker; select several markers first to have it go over all of them.";
  const std::size_t n = edit.patch->nodes.size();
  return (n == 1 ? std::string("One node is held.") : std::to_string(n) + " nodes are held.") +
         " Drag any of them, or an arrow.";
}

std::string chosen_arc(const ShapeEdit& edit) {
  if (!edit.arc) return "Drag a boundary node. Shift+click takes the arc up to another one.";
  return edit.arc->first == edit.arc->last ? "One node is held. Drag it in the picture."
                                           : "An arc is held. Drag any of its nodes.";
}

/// Draws the direction of displacement in a plane mesh; the sine runs at right angles to it.
void draw_plane_axes(SineDeformation& sine) {
  std::size_t direction = axis_of(sine) == 0 ? 1 : 0;
  if (axis_of(sine) == 2 || sine.along) set_axes(sine, 1, std::nullopt);
  if (ui::choice("shape/direction", "Direction", {"y", "x"}, direction,
                 "Which way the boundary is displaced; the sine runs along the body at right "
                 "angles to it.",
                 label_share))
    set_axes(sine, direction == 1 ? 0 : 1, std::nullopt);
}

/// Draws the same in space, and the axis along which the sine runs.
void draw_space_axes(SineDeformation& sine) {
  std::size_t direction = axis_of(sine), along = direction == 2 ? 0 : 2;
  for (std::size_t k = 0; k < 3 && sine.along; ++k)
    if (*sine.along == Vec3::Unit(static_cast<Index>(k))) along = k;
  bool changed = !sine.along;
  changed |= ui::choice("shape/direction", "Direction", {"x", "y", "z"}, direction,
                        "Which way the boundary is displaced.", label_share);
  changed |= ui::choice("shape/along", "Runs along", {"x", "y", "z"}, along,
                        "The axis along which the sine runs, from one end of the body to the "
                        "other. At right angles to it nothing changes.",
                        label_share);
  if (changed) set_axes(sine, direction, along);
}

/// The parts of the panel that differ between the plane and space.
struct ShapeForm {
  const char* edit_tip;
  std::string (*held)(const ShapeEdit&);
  void (*draw_axes)(SineDeformation&);
  const char* ends;  ///< tooltip: where the sine starts and ends
};
constexpr ShapeForm plane_form{"Drag single nodes or arcs of a boundary instead of whole bodies.",
                               chosen_arc, draw_plane_axes,
                               "Start and end are those of smallest and largest x (for direction "
                               "y)."};
constexpr ShapeForm space_form{"Drag nodes or patches of a surface instead of whole bodies.",
                               chosen_patch, draw_space_axes,
                               "Start and end are those along the axis in which the sine runs: of "
                               "its smallest and its largest coordinate."};

/// Changes shapes: by dragging, or by a sine along the body with a preview of its outline.
class ShapePanel {
 public:
  void draw(const PanelContext& context) {
    if (!ui::section("section/shape", "Change the shape")) {
      if (context.session.selection().deformation_preview())
        context.emit(action::PreviewDeformation{});
      return;
    }
    if (!context.session.document()) return ui::text_dim("No mesh is open.");
    const ShapeForm& form = context.session.in_space() ? space_form : plane_form;
    ImGui::BeginDisabled(context.session.dragging());
    draw_by_hand(context, form);
    draw_sine(context, form);
    draw_files(context);
    ImGui::EndDisabled();
  }

 private:
  static void draw_by_hand(const PanelContext& context, const ShapeForm& form) {
    const ShapeEdit& edit = context.session.selection().shape_edit();
    bool active = edit.active;
    if (ui::checkbox("shape/edit", "Edit boundary nodes (E)", active, form.edit_tip))
      context.emit(action::SetShapeEdit{active, edit.radius});
    if (!edit.active) return;
    double radius = edit.radius;
    constexpr const char* tip =
        "How far along the boundary a drag fades out, in units of the mesh; 0 moves the held nodes "
        "alone. The wheel changes it during a drag.";
    ui::row("Falloff", tip, label_share);
    if (ui::number("shape/radius", radius, tip) && std::isfinite(radius))
      context.emit(action::SetShapeEdit{true, std::max(radius, 0.0)});
    ui::text_wrapped(form.held(edit));
  }

  void draw_sine(const PanelContext& context, const ShapeForm& form) {
    const Session& session = context.session;
    ui::text_dim("Sine along the selected body");
    if (session.selection().empty()) return ui::text_wrapped("Select a body first.");
    draw_fields(form);
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

  static void draw_files(const PanelContext& context) {
    const bool free = !context.session.in_motion() && !context.session.motions().busy();
    ui::text_dim("Single nodes, on the boundary and inside");
    if (ui::button("shape/displacements", "Displacements from a file...",
                   {"Move the nodes that a file names by node,dx,dy or x,y,dx,dy (in space with z "
                    "and dz), and smooth the mesh around them. The rest of the boundary stays.",
                    ui::ButtonStyle::normal, free, -1}))
      context.emit(action::ShowFileDialog{FilePurpose::displacements});
    if (ui::button("shape/positions", "Positions from a file...",
                   {"The same by a file of node,x,y (in space with z): where the nodes are "
                    "afterwards.",
                    ui::ButtonStyle::normal, free, -1}))
      context.emit(action::ShowFileDialog{FilePurpose::positions});
  }

  void draw_fields(const ShapeForm& form) {
    const auto field = [](const char* id, const char* label, double& value, const char* tip) {
      ui::row(label, tip, label_share);
      ui::number(id, value, tip);
    };
    field("shape/amplitude", "Amplitude", typed_.amplitude,
          "Largest displacement, in units of the mesh; negative turns the sine over.");
    field("shape/waves", "Waves", typed_.waves, "Full periods over the length of the body.");
    form.draw_axes(typed_);
    ui::choice("shape/fade", "Fade", {"None", "At the start", "At the end", "At both ends"},
               typed_.fade,
               "Where the displacement fades to nothing, so that an edge stays where it is. " +
                   std::string(form.ends),
               label_share);
    if (typed_.fade != Fade::none)
      field("shape/fade_length", "Fade length", typed_.fade_length,
            "Share of the body's length over which it fades, up to 0.5.");
  }

  SineDeformation typed_;
  bool preview_ = true;
};

}  // namespace

DrawPanel shape_panel() { return panel_of<ShapePanel>(); }

}  // namespace winslow::gui
