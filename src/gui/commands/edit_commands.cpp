#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/commands/user_command.h"
#include "gui/demos/demo_player.h"

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
  if (!context.session.boundary()) return found;
  for (const auto& body : context.session.boundary()->bodies())
    if (body.hole && !body.markers.empty()) found.push_back(body.markers);
  return found;
}

std::string without_bodies(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  return bodies(context).empty() ? "This mesh has no holes: no bodies." : "";
}

void select_all(const PanelContext& context) {
  std::vector<Index> all;
  for (const auto& body : bodies(context)) all.insert(all.end(), body.begin(), body.end());
  context.emit(action::SelectMarkers{all});
}

void select_next(const PanelContext& context) {
  const auto all = bodies(context);
  std::size_t next = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (context.session.selected(all[k].front())) next = (k + 1) % all.size();
  context.emit(action::SelectMarkers{all[next]});
}

}  // namespace

std::vector<UserCommand> edit_commands() {
  constexpr auto group = CommandGroup::edit;
  return {
      undo(),
      redo(),
      reset(),
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
       .keys = {key(GLFW_KEY_B)},
       .tooltip = "Select the bodies one after the other.",
       .blocked = without_bodies,
       .run = select_next},
      {.id = "select_none",
       .label = "Select nothing",
       .group = group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Select nothing.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (c.session.job().active()) return "Esc cancels the solver now.";
         if (c.demo.demo()) return "Esc ends the demo now.";
         return c.session.selection().empty() ? "Nothing is selected." : "";
       },
       .run = [](const PanelContext& c) { c.emit(action::SelectMarkers{}); }},
      {.id = "scramble",
       .label = "Scramble the interior",
       .group = group,
       .tooltip = "Put every interior node at a random place: a test of what smoothing can "
                  "recover.",
       .blocked = while_busy,
       .run = [](const PanelContext& c) { c.emit(action::Scramble{1}); },
       .starts_section = true},
  };
}

}  // namespace winslow::gui
