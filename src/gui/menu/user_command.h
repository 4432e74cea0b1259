#pragma once

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

/// How tables of commands write chords: key('F'), shift(key('F')), control(key('S')).
Chord key(int glfw_key);
Chord control(Chord chord);
Chord shift(Chord chord);
Chord alt(Chord chord);
Chord typed(char32_t character);

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

  /// Scripts find its menu entry as "menu/ID", its row in the palette as "palette/ID".
  std::string id = {};
  std::string label = {};
  CommandGroup group = CommandGroup::file;
  std::vector<Chord> keys = {};
  std::string tooltip = {};  ///< a sentence or two
  /// Other terms for what it does, by which it is found as well; separated by spaces.
  std::string words = {};
  /// Why it cannot be done now, as a sentence; empty: it can. Null: it always can.
  Text blocked = {};
  Test checked = {};  ///< for what is on or off; null: it is neither
  /// Emits what is to happen. Called only when it is not blocked.
  std::function<void(const PanelContext&)> run = {};
  /// Of other meshes it is blocked, before `blocked` is asked.
  MeshKinds serves = all_meshes;
  Text label_now = {};  ///< label that says what would happen ("Undo: Smooth"); null: `label`
  bool starts_section = false;  ///< a line above it in the menu
  /// A submenu: what it holds now, in place of `run`. The palette lists them one by one.
  std::function<std::vector<UserCommand>(const PanelContext&)> items = {};
};

/// All commands, group after group.
const std::vector<UserCommand>& user_commands();
/// The command of that id; it must exist.
const UserCommand& user_command(std::string_view id);

std::string_view group_label(CommandGroup group);
/// Why something that is for such meshes cannot be done to the one that is open, as a sentence;
/// empty: it can, or none is open.
std::string why_not_served(MeshKinds serves, const PanelContext& context);
/// Empty if it can be done now.
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

// What stands in the way of many commands.
std::string without_mesh(const PanelContext& context);
/// No mesh, or the solver is at work on it.
std::string while_busy(const PanelContext& context);

/// Runs the commands whose keys were pressed in this frame (gui/menu/user_command.h). Call it
/// within a frame, not while a dialog is open or a field is being typed in. dragging: what happens
/// then is the mouse's business, and only the view's keys count.
void handle_shortcuts(const PanelContext& context, bool dragging);

}  // namespace winslow::gui
