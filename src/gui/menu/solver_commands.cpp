#include "gui/document/session/mesh_layers.h"
#include "gui/menu/bodies.h"
#include "gui/menu/user_command.h"

namespace winslow::gui {

namespace {

bool at_work(const PanelContext& context) {
  return context.session.job().active() && !context.session.job().paused();
}

std::string while_dragging(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  return context.session.dragging() ? "A body is being dragged." : "";
}

}  // namespace

std::vector<UserCommand> solver_commands() {
  return {
      entry("run", "Smooth", {key(GLFW_KEY_SPACE)},
            "Smooth the mesh, its boundary held; goes on where the solver is paused.",
            emits(action::RunSmooth{}),
            {.words = "solve run start untangle repair optimise winslow",
             .blocked = first_of({unless([](const PanelContext& c) { return !at_work(c); },
                                         "The solver is at work."),
                                  without_mesh}),
             .label_now = [](const PanelContext& c) -> std::string {
               return c.session.job().paused() ? "Resume" : "Smooth";
             }}),
      entry("pause", "Pause", {key(GLFW_KEY_SPACE)}, "Stop after this iteration.",
            emits(action::PauseSolver{}),
            {.blocked = first_of({unless(at_work, "The solver is not at work."), while_dragging})}),
      entry("step", "Single step", {key('N')}, "One outer iteration, then pause.",
            emits(action::StepSolver{1}), {.blocked = while_dragging}),
      entry("step10", "Ten steps", {shift(key('N'))}, "Ten outer iterations, then pause.",
            emits(action::StepSolver{10}), {.blocked = while_dragging}),
      entry("cancel", "Cancel", {key(GLFW_KEY_ESCAPE)}, "Stop and put the mesh back as it was.",
            emits(action::CancelSolver{}),
            {.words = "abort stop",
             .blocked = unless([](const PanelContext& c) { return c.session.job().active(); },
                               "The solver is not at work.")}),
  };
}

namespace {

constexpr const char* no_quadrilaterals =
    "No quadrilaterals stand on the walls: there are no layers.";

std::vector<LayerWall> wall_of(const PanelContext& context, const std::vector<Index>& markers) {
  LayerWall wall;
  for (const Index m : markers) wall.markers.push_back(names_of(context, {m}));
  return {wall};
}

/// The selected markers, or else all markers with adjacent quadrilaterals (in a plane mesh).
std::vector<Index> walls_meant(const PanelContext& context) {
  if (!context.session.selection().empty()) return context.session.selection().markers();
  std::vector<Index> walls;
  if (context.topology()->kind() != MeshKind::plane) return walls;
  const auto count = static_cast<Index>(context.topology()->markers().size());
  for (Index m = 0; m < count; ++m)
    if (may_have_layers(*context.topology(), wall_of(context, {m}))) walls.push_back(m);
  return walls;
}

UserCommand color_by(LayerField field, const char* id, const char* label, const char* tooltip,
                     const char* words) {
  return entry(
      id, label, {}, tooltip,
      [field](const PanelContext& c) {
        c.edit_view([field](ViewOptions& view) {
          view.fill = true;
          view.color = field;
          view.range.reset();
        });
      },
      {.words = words,
       .blocked = first_of(
           {without_mesh,
            unless([](const PanelContext& c) { return c.session.mesh().layers() != nullptr; },
                   "No layers are known: insert or hold some first.")}),
       .checked = [field](const PanelContext& c) { return c.view.color == ElementField(field); },
       .serves = plane_meshes});
}

}  // namespace

std::string cannot_hold_layers(const PanelContext& context, const std::vector<Index>& markers) {
  if (std::string busy = while_busy(context); !busy.empty()) return busy;
  const std::vector<LayerWall> walls = wall_of(context, markers);
  if (context.topology()->kind() == MeshKind::volume) {
    if (markers.empty()) return "Select the walls first.";
    const auto& held = context.session.mesh().document()->state().held_walls;
    const bool all = std::ranges::all_of(walls[0].markers, [&](const std::string& name) {
      return std::ranges::find(held, name) != held.end();
    });
    return all ? "These layers are held already." : "";
  }
  if (!may_have_layers(*context.topology(), walls)) return no_quadrilaterals;
  return context.session.layers().all_held(walls) ? "These layers are held already." : "";
}

void hold_layers(const PanelContext& context, const std::vector<Index>& markers) {
  LayersCommand command;
  command.task = LayerTask::hold;
  command.layers.walls = wall_of(context, markers);
  command.control = true;
  command.smooth = context.session.solver_settings().smooth_options();
  context.session.layers().limit_to_present(command);
  context.emit(action::RunCommand{std::move(command), false});
}

std::vector<UserCommand> layer_commands() {
  return {
      entry("insert_layers", "Insert layers...", {},
            "Say in the panel \"Layers\" how many layers the selected walls get, and how high they "
            "are.",
            emits(action::EditField{"layers/count"}),
            {.words = "viscous boundary prism inflation quadrilaterals extrude add y+ wall",
             .blocked = selection_in_use,
             .serves = plane_meshes}),
      entry("respace_layers", "Respace layers...", {},
            "Give the layers that the selected walls have other heights.",
            emits(action::EditField{"layers/first"}),
            {.words = "height growth ratio first cell y+ wall",
             .blocked =
                 first_of({selection_in_use, unless(
                                                 [](const PanelContext& c) {
                                                   return may_have_layers(
                                                       *c.topology(),
                                                       wall_of(c, c.session.selection().markers()));
                                                 },
                                                 no_quadrilaterals)}),
             .serves = plane_meshes}),
      entry(
          "hold_layers", "Hold layers", {},
          "Keep the heights that layers have, whatever moves: of the selected walls or, in a plane "
          "mesh where nothing is selected, of all.",
          [](const PanelContext& c) { hold_layers(c, walls_meant(c)); },
          {.words = "keep freeze lock height wall",
           .blocked = first_of(
               {without_mesh,
                [](const PanelContext& c) { return cannot_hold_layers(c, walls_meant(c)); }}),
           .serves = movable_meshes}),
      entry("layers_panel", "Panel of layers", {},
            "Show the panel \"Layers\", with all that it says of them.",
            emits(action::EditField{"layers/"}),
            {.words = "show settings",
             .blocked = without_mesh,
             .serves = plane_meshes,
             .starts_section = true}),
      color_by(LayerField::layer, "color_layers", "Colour elements by layer",
               "The first layer at the wall is 1.", "metric show"),
      color_by(LayerField::spacing_error, "color_spacing",
               "Colour elements by the error of their height",
               "How far each layer is from the height that is asked for.", "metric show spacing"),
  };
}

}  // namespace winslow::gui
