#include "gui/menu/motion_commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/demos/demo_player.h"
#include "gui/menu/bodies.h"
#include "gui/view/tools/space_picker.h"

namespace winslow::gui {

namespace {

constexpr auto motion_group = CommandGroup::motion;

std::function<void(const PanelContext&)> edit_field(const char* field) {
  return [field](const PanelContext& c) { c.emit(action::EditField{field}); };
}

void edit_translation(const PanelContext& context) {
  context.emit(action::EditField{translation_field(context)});
}

/// What to do with one body after it is selected, for each body and marker of the mesh.
std::function<std::vector<UserCommand>(const PanelContext&)> for_each_body(const char* id,
                                                                           const char* tooltip,
                                                                           const char* words,
                                                                           const char* field) {
  return [=](const PanelContext& context) {
    std::vector<UserCommand> items;
    for (const NamedBody& body : bodies_and_markers(context))
      items.push_back({.id = std::string(id) + "/" + body.name,
                       .label = body.name,
                       .group = motion_group,
                       .tooltip = tooltip,
                       .words = words,
                       .blocked = [markers = body.markers](const PanelContext& c) -> std::string {
                         const std::string locked = locked_marker(c, markers);
                         return locked.empty() ? "" : locked + " is locked.";
                       },
                       .run =
                           [markers = body.markers, field](const PanelContext& c) {
                             c.emit(action::SelectMarkers{markers, false});
                             if (field == std::string_view("motion/dx"))
                               edit_translation(c);
                             else if (*field)
                               c.emit(action::EditField{field});
                           }});
    return items;
  };
}

UserCommand type_pivot() {
  return {.id = "pivot/type",
          .label = "By numbers...",
          .group = motion_group,
          .tooltip = "Type where the pivot is.",
          .run = edit_field("motion/pivot_x"),
          .starts_section = true};
}

std::vector<UserCommand> pivot_places(const PanelContext& context) {
  if (context.session.in_space()) {
    std::vector<UserCommand> items = pivots_in_space();
    items.push_back(type_pivot());
    return items;
  }
  constexpr std::array<std::pair<PivotPlace, const char*>, 4> places{
      {{PivotPlace::centre, "Centre"},
       {PivotPlace::centroid, "Centroid"},
       {PivotPlace::leading_edge, "Leading edge"},
       {PivotPlace::trailing_edge, "Trailing edge"}}};
  std::vector<UserCommand> items;
  for (const auto& [place, label] : places)
    items.push_back({.id = std::string("pivot/") + label,
                     .label = label,
                     .group = motion_group,
                     .tooltip = "Turn the selection about this point of it.",
                     .checked =
                         [place = place](const PanelContext& c) {
                           return !c.session.selection().empty() &&
                                  c.session.selection().pivot_place() == place;
                         },
                     .run =
                         [place = place](const PanelContext& c) {
                           c.emit(action::SetPivot{{}, place});
                         }});
  items.push_back(type_pivot());
  return items;
}

std::vector<UserCommand> moving_commands() {
  return {
      {.id = "move",
       .label = "Move the selection...",
       .group = motion_group,
       .tooltip = "Type how far the selected bodies move, and press Enter; the mesh follows.",
       .words = "translate shift displace body motion",
       .blocked = selection_in_use,
       .run = edit_translation},
      {.id = "rotate",
       .label = "Rotate the selection...",
       .group = motion_group,
       .tooltip = "Type by how many degrees the selected bodies turn, and press Enter; the mesh "
                  "follows.",
       .words = "turn angle deflect pitch body motion",
       .blocked = selection_in_use,
       .run = edit_field("motion/rotate")},
      {.id = "pivot",
       .label = "Pivot",
       .group = motion_group,
       .tooltip = "The point about which the selection turns.",
       .words = "hinge centre rotation axis",
       .blocked = without_selection,
       .items = pivot_places},
      {.id = "pivot_pick_done",
       .label = "End the picking of a pivot",
       .group = motion_group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Clicks in the picture select again.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (c.session.job().active()) return "Esc cancels the solver now.";
         return c.session.selection().space().pick() ? "" : "No pivot is being picked.";
       },
       .run = [](const PanelContext& c) { c.emit(action::PickPivot{}); },
       .serves = volume_meshes},
      {.id = "move_body",
       .label = "Move",
       .group = motion_group,
       .tooltip = "Select a body and type how far it moves.",
       .words = "body marker translate shift",
       .blocked = while_busy,
       .starts_section = true,
       .items =
           for_each_body("move_body", "Select it and type how far it moves.", "", "motion/dx")},
      {.id = "rotate_body",
       .label = "Rotate",
       .group = motion_group,
       .tooltip = "Select a body and type by how many degrees it turns.",
       .words = "body marker turn angle deflect",
       .blocked = while_busy,
       .items = for_each_body("rotate_body", "Select it and type by how many degrees it turns.", "",
                              "motion/rotate")},
  };
}

std::vector<UserCommand> selection_commands() {
  return {
      {.id = "select",
       .label = "Select",
       .group = motion_group,
       .tooltip = "Take a body or a marker: what is selected moves, the rest stays.",
       .words = "body marker choose pick",
       .blocked = without_mesh,
       .starts_section = true,
       .items = for_each_body("select", "Select it alone.", "", "")},
      {.id = "select_all",
       .label = "Select all bodies",
       .group = motion_group,
       .keys = {control(key(GLFW_KEY_A))},
       .tooltip = "Select every hole of the mesh that is not locked, the outer boundary left out.",
       .words = "choose markers everything",
       .blocked = without_bodies,
       .run =
           [](const PanelContext& c) {
             std::vector<Index> all;
             for (const NamedBody& body : bodies(c))
               if (locked_marker(c, body.markers).empty())
                 all.insert(all.end(), body.markers.begin(), body.markers.end());
             c.emit(action::SelectMarkers{all});
           }},
      {.id = "select_next",
       .label = "Select the next body",
       .group = motion_group,
       .keys = {key(GLFW_KEY_TAB)},
       .tooltip = "Select the bodies one after the other.",
       .blocked = without_bodies,
       .run = [](const PanelContext& c) { cycle_bodies(c, 1); }},
      {.id = "select_previous",
       .label = "Select the body before",
       .group = motion_group,
       .keys = {shift(key(GLFW_KEY_TAB))},
       .tooltip = "Select the bodies one after the other, backwards.",
       .blocked = without_bodies,
       .run = [](const PanelContext& c) { cycle_bodies(c, -1); }},
      {.id = "select_none",
       .label = "Select nothing",
       .group = motion_group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Select nothing.",
       .words = "deselect clear",
       .blocked = [](const PanelContext& c) -> std::string {
         if (c.session.job().active()) return "Esc cancels the solver now.";
         if (c.demo.demo()) return "Esc ends the demo now.";
         if (c.session.selection().space().pick()) return "Esc ends the picking of a pivot now.";
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
       .group = motion_group,
       .keys = {key(GLFW_KEY_E)},
       .tooltip = "Drag single nodes or arcs of a boundary instead of whole bodies.",
       .words = "shape morph deform drag arc",
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
       .group = motion_group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Whole bodies are dragged again.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (c.session.job().active()) return "Esc cancels the solver now.";
         if (c.session.selection().space().pick()) return "Esc ends the picking of a pivot now.";
         return c.session.selection().shape_edit().active ? "" : "No nodes are being edited.";
       },
       .run =
           [](const PanelContext& c) {
             c.emit(action::SetShapeEdit{false, c.session.selection().shape_edit().radius});
           }},
      {.id = "deform",
       .label = "Deform by a sine...",
       .group = motion_group,
       .tooltip = "Type a sine that bends the selected bodies.",
       .words = "shape wave bend morph amplitude",
       .blocked = selection_in_use,
       .run = edit_field("shape/amplitude")},
  };
}

}  // namespace

std::vector<UserCommand> motion_commands() {
  std::vector<UserCommand> commands = moving_commands();
  for (const auto& part : {selection_commands(), shape_commands()})
    commands.insert(commands.end(), part.begin(), part.end());
  return commands;
}

std::vector<UserCommand> pivots_in_space() {
  struct Pick {
    PivotFrom from;
    const char *id, *label, *tooltip;
  };
  constexpr std::array<Pick, 4> picks{
      {{PivotFrom::edge, "pivot/edge", "An edge (hinge)...",
        "Click an edge in the picture: the selection turns about it. A row of sharp edges that "
        "goes "
        "on straight is taken as one."},
       {PivotFrom::nodes, "pivot/nodes", "Two nodes...",
        "Click two nodes in the picture: the selection turns about the line through both."},
       {PivotFrom::face, "pivot/face", "A face...",
        "Click a face in the picture: the selection turns about its normal."},
       {PivotFrom::node, "pivot/node", "A node...",
        "Click a node in the picture: the selection turns about it; the axis keeps its "
        "direction."}}};
  std::vector<UserCommand> items;
  items.push_back({.id = "pivot/Centre",
                   .label = "Centre",
                   .group = CommandGroup::motion,
                   .tooltip = "Turn the selection about the centre of its bounding box.",
                   .checked =
                       [](const PanelContext& c) {
                         return c.session.selection().space().source().from == PivotFrom::centre;
                       },
                   .run = [](const PanelContext& c) { c.emit(action::SetSpacePivot{}); }});
  for (const Pick& pick : picks)
    items.push_back(
        {.id = pick.id,
         .label = pick.label,
         .group = CommandGroup::motion,
         .tooltip = pick.tooltip,
         .words = "hinge axis rotation",
         .checked =
             [from = pick.from](const PanelContext& c) {
               return c.session.selection().space().source().from == from;
             },
         .run = [from = pick.from](const PanelContext& c) { c.emit(action::PickPivot{from}); }});
  return items;
}

std::vector<UserCommand> turn_about_place(const PickedPlace& place) {
  if (!place.in_space || !place.element || place.markers.size() != 1) return {};
  const SeenPlace seen{(*place.in_space)[0], (*place.in_space)[1], *place.element,
                       place.markers.front(), place.node};
  const auto command = [&seen](PivotFrom from, const char* id, const char* label,
                               const char* tooltip) {
    return UserCommand{
        .id = id,
        .label = label,
        .tooltip = tooltip,
        .blocked = without_selection,
        .run = [seen, from](const PanelContext& c) {
          if (const auto source = PivotPicker().source_at(seen, from, std::nullopt, c.session))
            c.emit(action::TakePivot{*source});
        }};
  };
  std::vector<UserCommand> commands{
      command(PivotFrom::edge, "place/pivot_edge", "Turn the selection about this edge",
              "The nearest edge is the axis, as of a hinge; a row of sharp edges that goes on "
              "straight is taken as one."),
      command(PivotFrom::face, "place/pivot_face", "Turn the selection about this face's normal",
              "The axis goes through the centre of the face, at right angles to it."),
      command(PivotFrom::node, "place/pivot_node", "Put the selection's pivot at this node",
              "The node of the face that is nearest. The axis keeps its direction.")};
  commands.front().starts_section = true;
  return commands;
}

}  // namespace winslow::gui
