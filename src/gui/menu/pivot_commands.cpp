#include "gui/menu/pivot_commands.h"

#include <array>
#include <string>

#include "gui/menu/bodies.h"
#include "gui/view/tools/pivot_picker.h"

namespace winslow::gui {

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
