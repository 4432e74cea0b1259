#pragma once

#include "gui/base/input.h"
#include "gui/document/session/session.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Keys pressed together: one key with Control, Alt or Shift held, or a character in any keyboard
/// layout.
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
/// True if the keys went down in this frame with exactly these modifiers. Super also counts as
/// Control.
bool pressed(const Chord& chord);

/// Chords in tables of commands: key('F'), shift(key('F')), control(key('S')). GLFW's codes of
/// letters and digits are those of ASCII.
constexpr Chord key(int glfw_key) { return {glfw_key}; }
constexpr Chord control(const Chord& c) { return {c.key, true, c.shift, c.character, c.alt}; }
constexpr Chord shift(const Chord& c) { return {c.key, c.control, true, c.character, c.alt}; }
constexpr Chord alt(const Chord& c) { return {c.key, c.control, c.shift, c.character, true}; }
constexpr Chord typed(char32_t character) { return {0, false, false, character}; }

/// All named commands of the user. The menus, the keys, the palette, the list of keys and the
/// toolbar's tooltips read this table: a command outside it has no key and no menu entry.
///
/// TO ADD A COMMAND, add an entry to the table of its group: file_commands.cpp (files, edits),
/// motion_commands.cpp, solver_commands.cpp (layers, solver), view_commands.cpp (the view, also of
/// space) or help_commands.cpp (demos, help). Its order there is its order in the menu. The context
/// menu is defined in context_commands.cpp; the mouse actions in the list of keys are in
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
  CommandGroup group = CommandGroup::file;  ///< of the table that contains it
  std::vector<Chord> keys = {};
  std::string tooltip = {};  ///< a sentence or two
  /// Other search terms for the command, separated by spaces.
  std::string words = {};
  /// Why the command is unavailable now, a sentence; empty: it is available. Null: always
  /// available.
  Text blocked = {};
  Test checked = {};  ///< state of a switch; null: not a switch
  /// Emits the actions. Called only if the command is not blocked.
  Run run = {};
  /// The supported meshes; for others the command is blocked without a call of `blocked`.
  MeshKinds serves = all_meshes;
  Text label_now = {};          ///< label for the present state ("Undo: Smooth"); null: `label`
  bool starts_section = false;  ///< a line above it in the menu
  /// Present entries of a submenu, which has no `run`. The palette lists them one by one.
  Items items = {};
};

/// An entry of a table: the fields that every command has, then in `more` the others.
UserCommand entry(std::string id, std::string label, std::vector<Chord> keys, std::string tooltip,
                  UserCommand::Run run, UserCommand more = {});
/// An entry that opens a submenu.
UserCommand submenu(std::string id, std::string label, std::string tooltip,
                    UserCommand::Items items, UserCommand more = {});

/// UserCommand::run that emits one action.
template <class A>
UserCommand::Run emits(A action) {
  return [action = std::move(action)](const PanelContext& c) { c.emit(action); };
}
/// UserCommand::blocked that returns the reason while the test fails.
UserCommand::Text unless(UserCommand::Test can, std::string reason);
/// UserCommand::blocked that returns the first non-empty reason.
UserCommand::Text first_of(std::vector<UserCommand::Text> reasons);

/// All commands, group after group.
const std::vector<UserCommand>& user_commands();
/// The command with that id, which must exist.
const UserCommand& user_command(std::string_view id);

std::string_view group_label(CommandGroup group);
/// Why the command is unavailable now, a sentence; empty: it is available.
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

/// An item at the place of a right click: the heading of its menu section ("flap", "Node 12") and
/// its commands.
struct ContextPart {
  std::string title;
  std::vector<UserCommand> commands;
};
/// The context menu of a right click: first the body or marker, then the node, the element, and
/// last commands on the view. They emit the same actions as menus and panels; commands that the
/// menus also have are taken from their table.
std::vector<ContextPart> context_parts(const PanelContext& context, const PickedPlace& place);
/// Context menu commands that set the selection's pivot at a place of a surface in space.
std::vector<UserCommand> turn_about_place(const PickedPlace& place);

// Common reasons for UserCommand::blocked.
std::string without_mesh(const PanelContext& context);
/// No mesh, or the solver is running.
std::string while_busy(const PanelContext& context);
/// The largest number of cuts is reached.
UserCommand::Text while_cuts_are_full();
/// Why the layers at these markers cannot be held now.
std::string cannot_hold_layers(const PanelContext& context, const std::vector<Index>& markers);
/// Holds the heights of the layers at these markers in all motions.
void hold_layers(const PanelContext& context, const std::vector<Index>& markers);

/// Runs the commands whose keys were pressed in this frame (gui/menu/user_command.h). Call it
/// within a frame, not while a dialog is open or a text field is active. dragging: a drag is
/// active, and only the keys of the view are handled.
void handle_shortcuts(const PanelContext& context, bool dragging);

/// How well a command matches a query; none: it does not.
///
/// Commands that contain every word of the query rank first: those with whole words in their label
/// ("case e" finds "Case E"), then those with beginnings of words in their label ("rot" finds
/// "Rotate"), then those found by `words`. Other commands match by their letters in order
/// (fuzzy_score()): "legnd" finds "Legend". A plural finds the singular. Empty queries match
/// everything equally.
///
/// A score of at least `found_by_words` means that all words of the query were found; a lower one
/// means that only its letters were.
inline constexpr int found_by_words = 1'000'000;
std::optional<int> search_score(std::string_view query, std::string_view label,
                                std::string_view words);

/// How well the letters of a query match a text: the text must contain all of them, in this order,
/// in any case; spaces of the query are ignored. Letters at the beginning of words and adjacent
/// letters weigh more, so that "sa" ranks "Save as" before "Quality tab". None: no match.
std::optional<int> fuzzy_score(std::string_view query, std::string_view text);

}  // namespace winslow::gui
