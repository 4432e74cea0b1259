#include "gui/menu/user_command.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <iterator>
#include <stdexcept>

namespace winslow::gui {

namespace {

/// What has no counterpart in space (yet).
constexpr std::array<std::string_view, 11> of_planes{
    "magnifier",    "pin_magnifier", "nodes",          "rim_nodes",
    "directions",   "insert_layers", "respace_layers", "hold_layers",
    "layers_panel", "color_layers",  "color_spacing"};

/// What moves or bends a boundary: a surface keeps its shape.
constexpr std::array<std::string_view, 8> of_motions{
    "move", "rotate", "pivot", "move_body", "rotate_body", "shape_edit", "shape_done", "deform"};

}  // namespace

const std::vector<UserCommand>& user_commands() {
  static const std::vector<UserCommand> all = [] {
    std::vector<UserCommand> commands;
    for (auto make :
         {file_commands, edit_commands, motion_commands, layer_commands, solver_commands,
          view_commands, space_commands, help_commands, demo_commands}) {
      auto group = make();
      for (UserCommand& command : group) {
        if (std::ranges::find(of_planes, command.id) != of_planes.end())
          command.serves = plane_meshes;
        if (std::ranges::find(of_motions, command.id) != of_motions.end())
          command.serves = movable_meshes;
      }
      std::move(group.begin(), group.end(), std::back_inserter(commands));
    }
    return commands;
  }();
  return all;
}

const UserCommand& user_command(std::string_view id) {
  const auto& all = user_commands();
  const auto it = std::find_if(all.begin(), all.end(), [id](const auto& c) { return c.id == id; });
  if (it == all.end()) throw std::logic_error("no user command \"" + std::string(id) + "\"");
  return *it;
}

std::string_view group_label(CommandGroup group) {
  switch (group) {
    case CommandGroup::file:
      return "File";
    case CommandGroup::edit:
      return "Edit";
    case CommandGroup::motion:
      return "Motion";
    case CommandGroup::layers:
      return "Layers";
    case CommandGroup::solver:
      return "Solver";
    case CommandGroup::view:
      return "View";
    case CommandGroup::help:
      return "Help";
  }
  return "";
}

std::string why_not_served(MeshKinds serves, const PanelContext& context) {
  const MeshKind kind = context.session.kind();
  if (!context.session.document() || serves.contains(kind)) return {};
  const bool of_surfaces = serves.contains(MeshKind::surface);
  const bool of_volumes = serves.contains(MeshKind::volume);
  if (kind == MeshKind::plane)
    return of_surfaces ? "Only for surface and volume meshes." : "Only for volume meshes.";
  if (kind == MeshKind::volume) return "Not for volume meshes yet.";
  if (!of_volumes) return "Not for surface meshes.";
  return serves.contains(MeshKind::plane)
             ? "Not for surface meshes: the surface keeps its shape, and nodes move on it."
             : "Only for volume meshes: a surface mesh has nothing inside.";
}

std::string why_blocked(const UserCommand& command, const PanelContext& context) {
  if (std::string reason = why_not_served(command.serves, context); !reason.empty()) return reason;
  return command.blocked ? command.blocked(context) : std::string();
}

std::string label_of(const UserCommand& command, const PanelContext& context) {
  return command.label_now ? command.label_now(context) : command.label;
}

std::string tooltip_of(const UserCommand& command) {
  const std::string keys = chords_text(command.keys);
  const std::string text = command.tooltip.empty() ? command.label : command.tooltip;
  return keys.empty() ? text : text + " (" + keys + ")";
}

std::string without_mesh(const PanelContext& context) {
  return context.session.document() ? "" : "No mesh is open.";
}

std::string while_busy(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  return context.session.in_motion() ? "The solver is at work." : "";
}

namespace {

std::string key_name(int key) {
  constexpr std::array<std::pair<int, const char*>, 20> names{
      {{GLFW_KEY_SPACE, "Space"},
       {GLFW_KEY_ESCAPE, "Esc"},
       {GLFW_KEY_ENTER, "Enter"},
       {GLFW_KEY_TAB, "Tab"},
       {GLFW_KEY_BACKSPACE, "Backspace"},
       {GLFW_KEY_DELETE, "Delete"},
       {GLFW_KEY_INSERT, "Insert"},
       {GLFW_KEY_LEFT, "Left"},
       {GLFW_KEY_RIGHT, "Right"},
       {GLFW_KEY_UP, "Up"},
       {GLFW_KEY_DOWN, "Down"},
       {GLFW_KEY_HOME, "Home"},
       {GLFW_KEY_END, "End"},
       {GLFW_KEY_PAGE_UP, "Page Up"},
       {GLFW_KEY_PAGE_DOWN, "Page Down"},
       {GLFW_KEY_EQUAL, "plus"},
       {GLFW_KEY_MINUS, "minus"},
       {GLFW_KEY_KP_ADD, "keypad plus"},
       {GLFW_KEY_KP_SUBTRACT, "keypad minus"},
       {GLFW_KEY_KP_0, "keypad 0"}}};
  for (const auto& [code, name] : names)
    if (code == key) return name;
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  return {static_cast<char>(key)};  // letters, digits and signs have the codes of ASCII
}

}  // namespace

std::string chord_text(const Chord& chord) {
  if (chord.key == 0) return {static_cast<char>(chord.character)};
  return std::string(chord.control ? "Ctrl+" : "") + (chord.alt ? "Alt+" : "") +
         (chord.shift ? "Shift+" : "") + key_name(chord.key);
}

std::string chords_text(const std::vector<Chord>& chords) {
  std::string text;
  for (const Chord& chord : chords) text += (text.empty() ? "" : ", ") + chord_text(chord);
  return text;
}

bool pressed(const Chord& chord) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool control_held = io.KeyCtrl || io.KeySuper;
  if (chord.key == 0) {
    const auto& typed = io.InputQueueCharacters;
    return !control_held && std::find(typed.begin(), typed.end(),
                                      static_cast<ImWchar>(chord.character)) != typed.end();
  }
  // On many keyboards "+" is the key "=" with Shift.
  const bool shift_fits = io.KeyShift == chord.shift || chord.key == GLFW_KEY_EQUAL;
  return ImGui::IsKeyPressed(chord.key, false) && control_held == chord.control && shift_fits &&
         io.KeyAlt == chord.alt;
}

Chord key(int glfw_key) { return {glfw_key}; }

Chord control(Chord chord) {
  chord.control = true;
  return chord;
}

Chord shift(Chord chord) {
  chord.shift = true;
  return chord;
}

Chord alt(Chord chord) {
  chord.alt = true;
  return chord;
}

Chord typed(char32_t character) { return {0, false, false, character}; }

namespace {

/// In a drag digits are numbers, and X, Y, Z axes.
bool means_drag(const Chord& chord) {
  if (chord.control || chord.alt) return false;
  return (chord.key >= GLFW_KEY_0 && chord.key <= GLFW_KEY_9) ||
         (chord.key >= GLFW_KEY_KP_0 && chord.key <= GLFW_KEY_KP_9) ||
         (chord.key >= GLFW_KEY_X && chord.key <= GLFW_KEY_Z);
}

}  // namespace

void handle_shortcuts(const PanelContext& context, bool dragging) {
  for (const UserCommand& command : user_commands()) {
    if (dragging && command.group != CommandGroup::view) continue;
    const auto counts = [dragging](const Chord& chord) {
      return !(dragging && means_drag(chord)) && pressed(chord);
    };
    if (!std::any_of(command.keys.begin(), command.keys.end(), counts)) continue;
    if (why_blocked(command, context).empty()) command.run(context);
  }
}

}  // namespace winslow::gui
