#include "gui/menu/solver_commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

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
  constexpr auto group = CommandGroup::solver;
  return {
      {.id = "run",
       .label = "Smooth",
       .group = group,
       .keys = {key(GLFW_KEY_SPACE)},
       .tooltip = "Smooth the mesh, its boundary held; goes on where the solver is paused.",
       .words = "solve run start untangle repair optimise winslow",
       .blocked =
           [](const PanelContext& c) {
             return at_work(c) ? "The solver is at work." : without_mesh(c);
           },
       .run = [](const PanelContext& c) { c.emit(action::RunSmooth{}); },
       .label_now = [](const PanelContext& c) -> std::string {
         return c.session.job().paused() ? "Resume" : "Smooth";
       }},
      {.id = "pause",
       .label = "Pause",
       .group = group,
       .keys = {key(GLFW_KEY_SPACE)},
       .tooltip = "Stop after this iteration.",
       .blocked =
           [](const PanelContext& c) {
             return at_work(c) ? while_dragging(c) : "The solver is not at work.";
           },
       .run = [](const PanelContext& c) { c.emit(action::PauseSolver{}); }},
      {.id = "step",
       .label = "Single step",
       .group = group,
       .keys = {key(GLFW_KEY_N)},
       .tooltip = "One outer iteration, then pause.",
       .blocked = while_dragging,
       .run = [](const PanelContext& c) { c.emit(action::StepSolver{1}); }},
      {.id = "step10",
       .label = "Ten steps",
       .group = group,
       .keys = {shift(key(GLFW_KEY_N))},
       .tooltip = "Ten outer iterations, then pause.",
       .blocked = while_dragging,
       .run = [](const PanelContext& c) { c.emit(action::StepSolver{10}); }},
      {.id = "cancel",
       .label = "Cancel",
       .group = group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Stop and put the mesh back as it was.",
       .words = "abort stop",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.session.job().active() ? "" : "The solver is not at work.";
       },
       .run = [](const PanelContext& c) { c.emit(action::CancelSolver{}); }},
  };
}

namespace {

constexpr auto layer_group = CommandGroup::layers;

std::vector<LayerWall> wall_of(const PanelContext& context, const std::vector<Index>& markers) {
  LayerWall wall;
  for (const Index m : markers) wall.markers.push_back(names_of(context, {m}));
  return {wall};
}

/// The selected markers, or else all on which quadrilaterals stand.
std::vector<Index> walls_meant(const PanelContext& context) {
  if (!context.session.selection().empty()) return context.session.selection().markers();
  std::vector<Index> walls;
  const auto count = static_cast<Index>(context.topology()->markers().size());
  for (Index m = 0; m < count; ++m)
    if (may_have_layers(*context.topology(), wall_of(context, {m}))) walls.push_back(m);
  return walls;
}

std::string without_layers(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  return context.session.mesh().layers() ? "" : "No layers are known: insert or hold some first.";
}

UserCommand color_by(LayerField field, UserCommand command) {
  command.group = layer_group;
  command.blocked = without_layers;
  command.checked = [field](const PanelContext& c) { return c.view.color == ElementField(field); };
  command.run = [field](const PanelContext& c) {
    c.edit_view([field](ViewOptions& view) {
      view.fill = true;
      view.color = field;
      view.range.reset();
    });
  };
  return command;
}

}  // namespace

std::string cannot_hold_layers(const PanelContext& context, const std::vector<Index>& markers) {
  if (std::string busy = while_busy(context); !busy.empty()) return busy;
  const std::vector<LayerWall> walls = wall_of(context, markers);
  if (!may_have_layers(*context.topology(), walls))
    return "No quadrilaterals stand on the walls: there are no layers.";
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
  const auto in_panel = [](const char* field) {
    return [field](const PanelContext& c) { c.emit(action::EditField{field}); };
  };
  return {
      {.id = "insert_layers",
       .label = "Insert layers...",
       .group = layer_group,
       .tooltip =
           "Say in the panel \"Layers\" how many layers the selected walls get, and how high "
           "they are.",
       .words = "viscous boundary prism inflation quadrilaterals extrude add y+ wall",
       .blocked = selection_in_use,
       .run = in_panel("layers/count")},
      {.id = "respace_layers",
       .label = "Respace layers...",
       .group = layer_group,
       .tooltip = "Give the layers that the selected walls have other heights.",
       .words = "height growth ratio first cell y+ wall",
       .blocked = [](const PanelContext& c) -> std::string {
         if (std::string reason = selection_in_use(c); !reason.empty()) return reason;
         return may_have_layers(*c.topology(), wall_of(c, c.session.selection().markers()))
                    ? ""
                    : "No quadrilaterals stand on the walls: there are no layers.";
       },
       .run = in_panel("layers/first")},
      {.id = "hold_layers",
       .label = "Hold layers",
       .group = layer_group,
       .tooltip = "Keep the heights that layers have, whatever moves: of the selected walls or, "
                  "where nothing is selected, of all.",
       .words = "keep freeze lock height wall",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.session.document()) return without_mesh(c);
         return cannot_hold_layers(c, walls_meant(c));
       },
       .run = [](const PanelContext& c) { hold_layers(c, walls_meant(c)); }},
      {.id = "layers_panel",
       .label = "Panel of layers",
       .group = layer_group,
       .tooltip = "Show the panel \"Layers\", with all that it says of them.",
       .words = "show settings",
       .blocked = without_mesh,
       .run = in_panel("layers/"),
       .starts_section = true},
      color_by(LayerField::layer, {.id = "color_layers",
                                   .label = "Colour elements by layer",
                                   .tooltip = "The first layer at the wall is 1.",
                                   .words = "metric show"}),
      color_by(LayerField::spacing_error,
               {.id = "color_spacing",
                .label = "Colour elements by the error of their height",
                .tooltip = "How far each layer is from the height that is asked for.",
                .words = "metric show spacing"}),
  };
}

}  // namespace winslow::gui
