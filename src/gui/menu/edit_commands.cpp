#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/demos/demo_player.h"
#include "gui/menu/user_command.h"

namespace winslow::gui {

namespace {

const History* history(const PanelContext& context) {
  const Document* document = context.session.document();
  return document ? &document->history() : nullptr;
}

bool busy(const PanelContext& context) { return context.session.in_motion(); }

UserCommand undo() {
  return {.id = "undo",
          .label = "Undo",
          .group = CommandGroup::edit,
          .keys = {control(key(GLFW_KEY_Z))},
          .tooltip = "Undo the last command.",
          .blocked = [](const PanelContext& c) -> std::string {
            if (!history(c)) return without_mesh(c);
            return busy(c) || history(c)->can_undo() ? "" : "There is nothing to undo.";
          },
          .run = [](const PanelContext& c) { c.emit(action::Undo{}); },
          .label_now = [](const PanelContext& c) -> std::string {
            if (!history(c) || !history(c)->can_undo()) return "Undo";
            return "Undo: " + describe(history(c)->command(history(c)->position()));
          }};
}

UserCommand redo() {
  return {.id = "redo",
          .label = "Redo",
          .group = CommandGroup::edit,
          .keys = {control(shift(key(GLFW_KEY_Z))), control(key(GLFW_KEY_Y))},
          .tooltip = "Do again what was undone.",
          .blocked = [](const PanelContext& c) -> std::string {
            if (!while_busy(c).empty()) return while_busy(c);
            return history(c)->can_redo() ? "" : "There is nothing to redo.";
          },
          .run = [](const PanelContext& c) { c.emit(action::Redo{}); },
          .label_now = [](const PanelContext& c) -> std::string {
            if (!history(c) || !history(c)->can_redo()) return "Redo";
            return "Redo: " + describe(history(c)->command(history(c)->position() + 1));
          }};
}

UserCommand reset() {
  return {.id = "reset",
          .label = "Reset to the mesh as opened",
          .group = CommandGroup::edit,
          .keys = {control(key(GLFW_KEY_R))},
          .tooltip = "Back to the mesh as it was opened. Redo brings the commands back.",
          .blocked = [](const PanelContext& c) -> std::string {
            if (!history(c)) return without_mesh(c);
            return busy(c) || history(c)->position() > 0 ? "" : "This is the mesh as opened.";
          },
          .run = [](const PanelContext& c) { c.emit(action::GoToStep{0}); }};
}

/// Holes in the mesh: what a user would call a body.
std::vector<std::vector<Index>> bodies(const PanelContext& context) {
  std::vector<std::vector<Index>> found;
  if (!context.session.mesh().boundary()) return found;
  for (const auto& body : context.session.mesh().boundary()->bodies())
    if (body.hole && !body.markers.empty()) found.push_back(body.markers);
  return found;
}

void select_all(const PanelContext& context) {
  std::vector<Index> all;
  for (const auto& body : bodies(context)) all.insert(all.end(), body.begin(), body.end());
  context.emit(action::SelectMarkers{all});
}

constexpr auto group = CommandGroup::edit;

std::vector<UserCommand> selection_commands() {
  return {
      {.id = "select_all",
       .label = "Select all bodies",
       .group = group,
       .keys = {control(key(GLFW_KEY_A))},
       .tooltip = "Select every hole of the mesh, the outer boundary left out.",
       .blocked = without_bodies,
       .run = select_all,
       .starts_section = true},
      {.id = "select_next",
       .label = "Select the next body",
       .group = group,
       .keys = {key(GLFW_KEY_TAB)},
       .tooltip = "Select the bodies one after the other.",
       .blocked = without_bodies,
       .run = [](const PanelContext& c) { c.emit(action::CycleBody{1}); }},
      {.id = "select_previous",
       .label = "Select the body before",
       .group = group,
       .keys = {shift(key(GLFW_KEY_TAB))},
       .tooltip = "Select the bodies one after the other, backwards.",
       .blocked = without_bodies,
       .run = [](const PanelContext& c) { c.emit(action::CycleBody{-1}); }},
      {.id = "select_none",
       .label = "Select nothing",
       .group = group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Select nothing.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (c.session.job().active()) return "Esc cancels the solver now.";
         if (c.demo.demo()) return "Esc ends the demo now.";
         if (c.session.selection().shape_edit().active) return "Esc ends the editing of nodes now.";
         return c.session.selection().empty() ? "Nothing is selected." : "";
       },
       .run = [](const PanelContext& c) { c.emit(action::SelectMarkers{}); }},
  };
}

std::vector<UserCommand> shape_commands() {
  return {
      {.id = "shape_edit",
       .label = "Edit boundary nodes",
       .group = group,
       .keys = {key(GLFW_KEY_E)},
       .tooltip = "Drag single nodes or arcs of a boundary instead of whole bodies.",
       .blocked = without_mesh,
       .checked = [](const PanelContext& c) { return c.session.selection().shape_edit().active; },
       .run =
           [](const PanelContext& c) {
             const ShapeEdit& edit = c.session.selection().shape_edit();
             c.emit(action::SetShapeEdit{!edit.active, edit.radius});
           },
       .starts_section = true},
      {.id = "shape_done",
       .label = "End the editing of boundary nodes",
       .group = group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Whole bodies are dragged again.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (c.session.job().active()) return "Esc cancels the solver now.";
         return c.session.selection().shape_edit().active ? "" : "No nodes are being edited.";
       },
       .run =
           [](const PanelContext& c) {
             c.emit(action::SetShapeEdit{false, c.session.selection().shape_edit().radius});
           }},
  };
}

UserCommand scramble() {
  return {.id = "scramble",
          .label = "Scramble the interior",
          .group = group,
          .tooltip =
              "Put every interior node at a random place: a test of what smoothing can "
              "recover.",
          .blocked = while_busy,
          .run = [](const PanelContext& c) { c.emit(action::Scramble{1}); },
          .starts_section = true};
}

}  // namespace

std::string without_bodies(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  return bodies(context).empty() ? "This mesh has no holes: no bodies." : "";
}

std::vector<UserCommand> edit_commands() {
  std::vector<UserCommand> commands{undo(), redo(), reset()};
  for (const auto& part : {selection_commands(), shape_commands()})
    commands.insert(commands.end(), part.begin(), part.end());
  commands.push_back(scramble());
  return commands;
}

}  // namespace winslow::gui
