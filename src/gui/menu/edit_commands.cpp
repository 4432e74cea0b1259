#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/menu/user_command.h"

namespace winslow::gui {

namespace {

const History* history(const PanelContext& context) {
  const Document* document = context.session.document();
  return document ? &document->history() : nullptr;
}

bool busy(const PanelContext& context) { return context.session.in_motion(); }

/// What was told to a node last, at this mesh.
std::string undoable_override(const PanelContext& context) {
  const Document* document = context.session.document();
  return document && !busy(context)
             ? context.session.jobs().overrides().undoable(document->edits().revision())
             : std::string();
}
std::string redoable_override(const PanelContext& context) {
  const Document* document = context.session.document();
  return document ? context.session.jobs().overrides().redoable(document->edits().revision())
                  : std::string();
}

UserCommand undo() {
  return {.id = "undo",
          .label = "Undo",
          .group = CommandGroup::edit,
          .keys = {control(key(GLFW_KEY_Z))},
          .tooltip = "Undo the last command.",
          .blocked = [](const PanelContext& c) -> std::string {
            if (!history(c)) return without_mesh(c);
            return busy(c) || history(c)->can_undo() || !undoable_override(c).empty()
                       ? ""
                       : "There is nothing to undo.";
          },
          .run = [](const PanelContext& c) { c.emit(action::Undo{}); },
          .label_now = [](const PanelContext& c) -> std::string {
            if (const auto what = undoable_override(c); !what.empty()) return "Undo: " + what;
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
            return history(c)->can_redo() || !redoable_override(c).empty()
                       ? ""
                       : "There is nothing to redo.";
          },
          .run = [](const PanelContext& c) { c.emit(action::Redo{}); },
          .label_now = [](const PanelContext& c) -> std::string {
            if (const auto what = redoable_override(c); !what.empty()) return "Redo: " + what;
            if (!history(c) || !history(c)->can_redo()) return "Redo";
            return "Redo: " + describe(history(c)->command(history(c)->position() + 1));
          }};
}

UserCommand reset() {
  return {.id = "reset",
          .label = "Revert to opened mesh",
          .group = CommandGroup::edit,
          .keys = {control(key(GLFW_KEY_R))},
          .tooltip = "Back to the mesh as it was opened. Redo brings the commands back.",
          .words = "reset original loaded undo all",
          .blocked = [](const PanelContext& c) -> std::string {
            if (!history(c)) return without_mesh(c);
            return busy(c) || history(c)->position() > 0 ? "" : "This is the mesh as opened.";
          },
          .run = [](const PanelContext& c) { c.emit(action::GoToStep{0}); }};
}

UserCommand scramble() {
  return {.id = "scramble",
          .label = "Scramble the interior",
          .group = CommandGroup::edit,
          .tooltip =
              "Put every interior node at a random place: a test of what smoothing can "
              "recover.",
          .words = "random shuffle",
          .blocked = while_busy,
          .run = [](const PanelContext& c) { c.emit(action::Scramble{1}); },
          .starts_section = true};
}

}  // namespace

std::vector<UserCommand> edit_commands() { return {undo(), redo(), reset(), scramble()}; }

}  // namespace winslow::gui
