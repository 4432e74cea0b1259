#pragma once

#include "gui/base/input.h"
#include "gui/document/session/session.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Keys pressed together: one key with Control, Alt or Shift held, or a character however the
/// keyboard types it.
struct Chord {
  int key = 0;  ///< GLFW key code; 0: a character
  bool control = false;
  bool shift = false;
  char32_t character = 0;
  bool alt = false;

  bool operator==(const Chord&) const = default;
};

/// "Ctrl+Shift+S", "F2", "?".
std::string chord_text(const Chord& chord);
/// "Ctrl+Shift+Z, Ctrl+Y"; empty for none.
std::string chords_text(const std::vector<Chord>& chords);
/// Went down in this frame, with just these modifiers. Super stands in for Control where keyboards
/// have it.
bool pressed(const Chord& chord);

/// How tables of commands write chords: key('F'), shift(key('F')), control(key('S')). GLFW numbers
/// the keys of letters and digits as ASCII does.
constexpr Chord key(int glfw_key) { return {glfw_key}; }
constexpr Chord control(const Chord& c) { return {c.key, true, c.shift, c.character, c.alt}; }
constexpr Chord shift(const Chord& c) { return {c.key, c.control, true, c.character, c.alt}; }
constexpr Chord alt(const Chord& c) { return {c.key, c.control, c.shift, c.character, true}; }
constexpr Chord typed(char32_t character) { return {0, false, false, character}; }

/// Everything that a user can do by name. The menus, the keys, the palette, the list of keys and
/// the toolbar's tooltips all read this one table: what is not in it has no key and no menu entry.
///
/// TO ADD A COMMAND, add an entry to the table of its group: file_commands.cpp (files, edits),
/// motion_commands.cpp, solver_commands.cpp (layers, solver), view_commands.cpp (the view, also of
/// space) or help_commands.cpp (demos, help). Its order there is its order in the menu. What a
/// right click offers stands in context_commands.cpp, what the mouse does, for the list of keys, in
/// gui/panels/help_panel.cpp.

enum class CommandGroup { file, edit, motion, layers, solver, view, help };
/// In the order of the menus.
inline constexpr std::array<CommandGroup, 7> command_groups{
    CommandGroup::file,   CommandGroup::edit, CommandGroup::motion, CommandGroup::layers,
    CommandGroup::solver, CommandGroup::view, CommandGroup::help};

struct UserCommand {
  using Test = std::function<bool(const PanelContext&)>;
  using Text = std::function<std::string(const PanelContext&)>;
  using Run = std::function<void(const PanelContext&)>;
  using Items = std::function<std::vector<UserCommand>(const PanelContext&)>;

  /// Scripts find its menu entry as "menu/ID", its row in the palette as "palette/ID".
  std::string id = {};
  std::string label = {};
  CommandGroup group = CommandGroup::file;  ///< of the table that it stands in
  std::vector<Chord> keys = {};
  std::string tooltip = {};  ///< a sentence or two
  /// Other terms for what it does, by which it is found as well; separated by spaces.
  std::string words = {};
  /// Why it cannot be done now, as a sentence; empty: it can. Null: it always can.
  Text blocked = {};
  Test checked = {};  ///< for what is on or off; null: it is neither
  /// Emits what is to happen. Called only when it is not blocked.
  Run run = {};
  /// Of other meshes it is blocked, before `blocked` is asked.
  MeshKinds serves = all_meshes;
  Text label_now = {};  ///< label that says what would happen ("Undo: Smooth"); null: `label`
  bool starts_section = false;  ///< a line above it in the menu
  /// A submenu: what it holds now, in place of `run`. The palette lists them one by one.
  Items items = {};
};

/// An entry of a table: what every command has, then what only some have.
UserCommand entry(std::string id, std::string label, std::vector<Chord> keys, std::string tooltip,
                  UserCommand::Run run, UserCommand more = {});
/// An entry that opens a submenu.
UserCommand submenu(std::string id, std::string label, std::string tooltip,
                    UserCommand::Items items, UserCommand more = {});

/// UserCommand::run that emits just this.
template <class A>
UserCommand::Run emits(A action) {
  return [action = std::move(action)](const PanelContext& c) { c.emit(action); };
}
/// UserCommand::blocked: the reason, while the test fails.
UserCommand::Text unless(UserCommand::Test can, std::string reason);
/// The same: the first of these that says something.
UserCommand::Text first_of(std::vector<UserCommand::Text> reasons);

/// All commands, group after group.
const std::vector<UserCommand>& user_commands();
/// The command of that id; it must exist.
const UserCommand& user_command(std::string_view id);

std::string_view group_label(CommandGroup group);
/// Empty if it can be done now, else why not, as a sentence.
std::string why_blocked(const UserCommand& command, const PanelContext& context);
std::string label_of(const UserCommand& command, const PanelContext& context);
/// Its tooltip with its keys: "Show the whole mesh. (F)".
std::string tooltip_of(const UserCommand& command);

// The groups.
std::vector<UserCommand> file_commands();
std::vector<UserCommand> edit_commands();
std::vector<UserCommand> motion_commands();
std::vector<UserCommand> layer_commands();
std::vector<UserCommand> solver_commands();
std::vector<UserCommand> view_commands();
std::vector<UserCommand> space_commands();
std::vector<UserCommand> help_commands();
std::vector<UserCommand> demo_commands();

/// What lies at a place of a right click, as the head of a menu: "flap", "Node 12", and what can be
/// done with it.
struct ContextPart {
  std::string title;
  std::vector<UserCommand> commands;
};
/// What a right click offers: the body or marker first, then the node, the element, and last what
/// is of the view. The commands emit the same actions as menus and panels do; those that the menus
/// have as they are come from their table.
std::vector<ContextPart> context_parts(const PanelContext& context, const PickedPlace& place);
/// What the selection can turn about at a place of a surface in space, for a right click there.
std::vector<UserCommand> turn_about_place(const PickedPlace& place);

// What stands in the way of many commands, as UserCommand::blocked.
std::string without_mesh(const PanelContext& context);
/// No mesh, or the solver is at work on it.
std::string while_busy(const PanelContext& context);
/// There are as many cuts as there may be.
UserCommand::Text while_cuts_are_full();
/// Why the layers at these markers cannot be held now.
std::string cannot_hold_layers(const PanelContext& context, const std::vector<Index>& markers);
/// Keeps the heights of the layers at these markers, whatever moves.
void hold_layers(const PanelContext& context, const std::vector<Index>& markers);

/// Runs the commands whose keys were pressed in this frame (gui/menu/user_command.h). Call it
/// within a frame, not while a dialog is open or a field is being typed in. dragging: what happens
/// then is the mouse's business, and only the view's keys count.
void handle_shortcuts(const PanelContext& context, bool dragging);

/// How well a command fits what was typed; none: it does not.
///
/// Commands that have every word of the query come first: those that have them in their label as
/// they are typed ("case e" finds "Case E"), then those with a word of the label that begins so
/// ("rot" finds "Rotate"), then those found by `words`, which say in other terms what the command
/// is about. What is left is found by its letters in their order (fuzzy_score()), so that "legnd"
/// finds "Legend". A plural finds the singular. Empty queries fit everything alike.
///
/// From `found_by_words` on all words of the query were found; below, its letters.
inline constexpr int found_by_words = 1'000'000;
std::optional<int> search_score(std::string_view query, std::string_view label,
                                std::string_view words);

/// How well the letters of a query fit a text: all of them must be in it, in this order, in any
/// case; spaces of the query do not count. Letters at the beginning of words and letters side by
/// side weigh more, so that "sa" finds "Save as" before "Quality tab". None: it does not fit.
std::optional<int> fuzzy_score(std::string_view query, std::string_view text);

}  // namespace winslow::gui
