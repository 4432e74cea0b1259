#include "gui/demos/demo_player.h"
#include "gui/menu/bodies.h"
#include "gui/menu/user_command.h"
#include "gui/view/tools/space_picker.h"

namespace winslow::gui {

namespace {

UserCommand::Run edit_field(const char* field) { return emits(action::EditField{field}); }

void edit_translation(const PanelContext& context) {
  context.emit(action::EditField{translation_field(context)});
}

/// Submenu items that select a body or marker of the mesh and then run `then`; null: only select.
UserCommand::Items for_each_body(const char* id, const char* tooltip,
                                 const UserCommand::Run& then) {
  return [=](const PanelContext& context) {
    std::vector<UserCommand> items;
    for (const NamedBody& body : bodies_and_markers(context))
      items.push_back(entry(std::string(id) + "/" + body.name, body.name, {}, tooltip,
                            [markers = body.markers, then](const PanelContext& c) {
                              c.emit(action::SelectMarkers{markers, false});
                              if (then) then(c);
                            },
                            {.blocked = while_locked(body.markers)}));
    return items;
  };
}

/// Commands that set the pivot in a plane mesh.
std::vector<UserCommand> plane_pivots() {
  constexpr std::array<std::pair<PivotPlace, const char*>, 4> places{
      {{PivotPlace::centre, "Centre"},
       {PivotPlace::centroid, "Centroid"},
       {PivotPlace::leading_edge, "Leading edge"},
       {PivotPlace::trailing_edge, "Trailing edge"}}};
  std::vector<UserCommand> items;
  for (const auto& [place, label] : places)
    items.push_back(entry(
        std::string("pivot/") + label, label, {}, "Turn the selection about this point of it.",
        emits(action::SetPivot{{}, place}), {.checked = [place = place](const PanelContext& c) {
          return !c.session.selection().empty() && c.session.selection().pivot_place() == place;
        }}));
  return items;
}

/// The same in space: the centre, or an item picked by the next click.
std::vector<UserCommand> space_pivots() {
  struct Pick {
    PivotFrom from;
    const char *id, *label, *tooltip;
    UserCommand::Run run;
  };
  const std::array<Pick, 5> picks{
      {{PivotFrom::centre, "pivot/Centre", "Centre",
        "Turn the selection about the centre of its bounding box.", emits(action::SetSpacePivot{})},
       {PivotFrom::edge, "pivot/edge", "An edge (hinge)...",
        "Click an edge in the picture: the selection turns about it. A row of sharp edges that "
        "goes on straight is taken as one.",
        emits(action::PickPivot{PivotFrom::edge})},
       {PivotFrom::nodes, "pivot/nodes", "Two nodes...",
        "Click two nodes in the picture: the selection turns about the line through both.",
        emits(action::PickPivot{PivotFrom::nodes})},
       {PivotFrom::face, "pivot/face", "A face...",
        "Click a face in the picture: the selection turns about its normal.",
        emits(action::PickPivot{PivotFrom::face})},
       {PivotFrom::node, "pivot/node", "A node...",
        "Click a node in the picture: the selection turns about it; the axis keeps its direction.",
        emits(action::PickPivot{PivotFrom::node})}}};
  std::vector<UserCommand> items;
  for (const auto& [from, id, label, tooltip, run] : picks)
    items.push_back(entry(id, label, {}, tooltip, run,
                          {.words = from == PivotFrom::centre ? "" : "hinge axis rotation",
                           .checked = [from = from](const PanelContext& c) {
                             return c.session.selection().space().source().from == from;
                           }}));
  return items;
}

std::vector<UserCommand> pivot_places(const PanelContext& context) {
  std::vector<UserCommand> items = context.session.in_space() ? space_pivots() : plane_pivots();
  items.push_back(entry("pivot/type", "By numbers...", {}, "Type where the pivot is.",
                        edit_field("motion/pivot_x"), {.starts_section = true}));
  return items;
}

bool idle(const PanelContext& c) { return !c.session.job().active(); }
bool picks_no_pivot(const PanelContext& c) { return !c.session.selection().space().pick(); }
bool edits_no_shape(const PanelContext& c) { return !c.session.selection().shape_edit().active; }

std::vector<UserCommand> moving_commands() {
  return {
      entry("move", "Move the selection...", {},
            "Type how far the selected bodies move, and press Enter; the mesh follows.",
            edit_translation,
            {.words = "translate shift displace body motion",
             .blocked = selection_in_use,
             .serves = movable_meshes}),
      entry("rotate", "Rotate the selection...", {},
            "Type by how many degrees the selected bodies turn, and press Enter; the mesh follows.",
            edit_field("motion/rotate"),
            {.words = "turn angle deflect pitch body motion",
             .blocked = selection_in_use,
             .serves = movable_meshes}),
      submenu("pivot", "Pivot", "The point about which the selection turns.", pivot_places,
              {.words = "hinge centre rotation axis",
               .blocked = without_selection,
               .serves = movable_meshes}),
      entry("pivot_pick_done", "End the picking of a pivot", {key(GLFW_KEY_ESCAPE)},
            "Clicks in the picture select again.", emits(action::PickPivot{}),
            {.blocked = first_of({unless(idle, "Esc cancels the solver now."),
                                  unless([](const PanelContext& c) { return !picks_no_pivot(c); },
                                         "No pivot is being picked.")}),
             .serves = volume_meshes}),
      submenu("move_body", "Move", "Select a body and type how far it moves.",
              for_each_body("move_body", "Select it and type how far it moves.", edit_translation),
              {.words = "body marker translate shift",
               .blocked = while_busy,
               .serves = movable_meshes,
               .starts_section = true}),
      submenu("rotate_body", "Rotate", "Select a body and type by how many degrees it turns.",
              for_each_body("rotate_body", "Select it and type by how many degrees it turns.",
                            edit_field("motion/rotate")),
              {.words = "body marker turn angle deflect",
               .blocked = while_busy,
               .serves = movable_meshes}),
  };
}

std::string without_list(const PanelContext& c) {
  return c.session.selection().plan().empty() ? "No bodies are listed." : "";
}

/// Why the listed bodies cannot be moved.
std::string list_that_stays(const PanelContext& c) {
  const BodyPlan& plan = c.session.selection().plan();
  if (!plan.moves()) return "None of the listed bodies has a motion yet.";
  return plan.fault();
}

bool lists_selection(const PanelContext& c) {
  const Selection& selection = c.session.selection();
  return !selection.empty() && selection.plan().find(selection.names()) != nullptr;
}

/// Lists the selection with no motion yet; the panel's fields then change that motion.
void list_selection(const PanelContext& c) {
  const Selection& selection = c.session.selection();
  RigidMotion none = motion_of(!c.session.in_space(), 0, Vec3(0, 0, 0), selection.space_pivot(),
                               selection.space().axis());
  none.pivot.reset();
  c.emit(action::PlanBody{none});
  c.emit(action::EditField{"motion/rotate"});
}

/// Bodies that move together, each by its own motion.
std::vector<UserCommand> list_commands() {
  return {
      entry("list_body", "List the selection to move with others...", {},
            "Bodies of the list move together, each by its own motion: type that of the selection, "
            "then list others.",
            list_selection,
            {.words = "several bodies together simultaneous each own motion",
             .blocked = first_of({selection_in_use,
                                  [](const PanelContext& c) {
                                    return lists_selection(c) ? "It is listed already." : "";
                                  }}),
             .serves = movable_meshes,
             .starts_section = true}),
      entry("list_apply", "Move the listed bodies together", {},
            "All at the same time, each along its own arc, as one step of the history.",
            emits(action::ApplyBodyPlan{}),
            {.words = "several bodies simultaneous apply all",
             .blocked = first_of({while_busy, without_list, list_that_stays}),
             .serves = movable_meshes}),
      entry("list_clear", "Clear the list of bodies", {}, "Nothing moves.",
            emits(action::ClearBodyPlan{}),
            {.words = "several bodies together empty",
             .blocked = first_of({while_busy, without_list}),
             .serves = movable_meshes}),
  };
}

void select_all_bodies(const PanelContext& c) {
  std::vector<Index> all;
  for (const NamedBody& body : bodies(c))
    if (locked_marker(c, body.markers).empty())
      all.insert(all.end(), body.markers.begin(), body.markers.end());
  c.emit(action::SelectMarkers{all});
}

std::vector<UserCommand> selection_commands() {
  return {
      submenu(
          "select", "Select", "Take a body or a marker: what is selected moves, the rest stays.",
          for_each_body("select", "Select it alone.", {}),
          {.words = "body marker choose pick", .blocked = without_mesh, .starts_section = true}),
      entry("select_all", "Select all bodies", {control(key('A'))},
            "Select every hole of the mesh that is not locked, the outer boundary left out.",
            select_all_bodies, {.words = "choose markers everything", .blocked = without_bodies}),
      entry("select_next", "Select the next body", {key(GLFW_KEY_TAB)},
            "Select the bodies one after the other.",
            [](const PanelContext& c) { cycle_bodies(c, 1); }, {.blocked = without_bodies}),
      entry("select_previous", "Select the body before", {shift(key(GLFW_KEY_TAB))},
            "Select the bodies one after the other, backwards.",
            [](const PanelContext& c) { cycle_bodies(c, -1); }, {.blocked = without_bodies}),
      entry("select_none", "Select nothing", {key(GLFW_KEY_ESCAPE)}, "Select nothing.",
            emits(action::SelectMarkers{}),
            {.words = "deselect clear",
             .blocked = first_of(
                 {unless(idle, "Esc cancels the solver now."),
                  unless([](const PanelContext& c) { return !c.demo.demo(); },
                         "Esc ends the demo now."),
                  unless(picks_no_pivot, "Esc ends the picking of a pivot now."),
                  unless(edits_no_shape, "Esc ends the editing of nodes now."),
                  unless([](const PanelContext& c) { return !c.session.selection().empty(); },
                         "Nothing is selected.")})}),
  };
}

/// Begins or ends the editing of the boundary's shape.
void edit_shape(const PanelContext& c) {
  const ShapeEdit& edit = c.session.selection().shape_edit();
  c.emit(action::SetShapeEdit{!edit.active, edit.radius});
}

std::vector<UserCommand> shape_commands() {
  return {
      entry("shape_edit", "Edit boundary nodes", {key('E')},
            "Drag single nodes or arcs of a boundary instead of whole bodies.", edit_shape,
            {.words = "shape morph deform drag arc",
             .blocked = without_mesh,
             .checked = [](const PanelContext& c) { return !edits_no_shape(c); },
             .serves = movable_meshes,
             .starts_section = true}),
      entry("shape_done", "End the editing of boundary nodes", {key(GLFW_KEY_ESCAPE)},
            "Whole bodies are dragged again.", edit_shape,
            {.blocked = first_of({unless(idle, "Esc cancels the solver now."),
                                  unless(picks_no_pivot, "Esc ends the picking of a pivot now."),
                                  unless([](const PanelContext& c) { return !edits_no_shape(c); },
                                         "No nodes are being edited.")}),
             .serves = movable_meshes}),
      entry("deform", "Deform by a sine...", {}, "Type a sine that bends the selected bodies.",
            edit_field("shape/amplitude"),
            {.words = "shape wave bend morph amplitude",
             .blocked = selection_in_use,
             .serves = movable_meshes}),
      entry("displacements", "Displace nodes by a file...", {},
            "Move the nodes that a file names, on the boundary and inside, as a structural solver "
            "hands them over, and smooth the mesh around them.",
            emits(action::ShowFileDialog{FilePurpose::displacements}),
            {.words = "table csv prescribe solid coupling deform",
             .blocked = while_busy,
             .serves = movable_meshes}),
      entry("positions", "Move nodes to positions of a file...", {},
            "The same by a file that says where the nodes are afterwards.",
            emits(action::ShowFileDialog{FilePurpose::positions}),
            {.words = "table csv prescribe solid coupling deform",
             .blocked = while_busy,
             .serves = movable_meshes}),
  };
}

}  // namespace

std::vector<UserCommand> motion_commands() {
  std::vector<UserCommand> commands = moving_commands();
  for (const auto& part : {list_commands(), selection_commands(), shape_commands()})
    commands.insert(commands.end(), part.begin(), part.end());
  return commands;
}

std::vector<UserCommand> turn_about_place(const PickedPlace& place) {
  if (!place.in_space || !place.element || place.markers.size() != 1) return {};
  const SeenPlace seen{(*place.in_space)[0], (*place.in_space)[1], *place.element,
                       place.markers.front(), place.node};
  const auto command = [&seen](PivotFrom from, const char* id, const char* label,
                               const char* tooltip) {
    return entry(
        id, label, {}, tooltip,
        [seen, from](const PanelContext& c) {
          if (const auto source = PivotPicker().source_at(seen, from, std::nullopt, c.session))
            c.emit(action::TakePivot{*source});
        },
        {.blocked = without_selection});
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
