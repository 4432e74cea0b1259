#include "gui/menu/user_command.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

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

}  // namespace winslow::gui
