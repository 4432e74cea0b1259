#include "gui/menu/bodies.h"
#include "gui/menu/user_command.h"
#include "gui/view/navigation/go_to.h"

namespace winslow::gui {

namespace {

/// UserCommand::run that changes the view's options.
template <class Change>
UserCommand::Run changes(Change how) {
  return [how](const PanelContext& c) { c.edit_view(how); };
}

/// A command that switches a part of the view on or off.
UserCommand toggle(bool ViewOptions::*part, UserCommand command) {
  command.checked = [part](const PanelContext& c) { return c.view.*part; };
  command.run = changes([part](ViewOptions& view) { view.*part = !(view.*part); });
  return command;
}

/// The same for options of meshes in space.
UserCommand space_toggle(bool SpaceOptions::*part, UserCommand command) {
  command.blocked = without_mesh;
  command.checked = [part](const PanelContext& c) { return c.view.space.*part; };
  command.run = changes([part](ViewOptions& view) { view.space.*part = !(view.space.*part); });
  return command;
}

/// A command that shows a tab of the column on the right.
UserCommand tab(SideTab which, UserCommand command) {
  command.checked = [which](const PanelContext& c) {
    return c.view_state.columns.right_open && c.view.side_tab == which;
  };
  command.run = [which](const PanelContext& c) {
    c.edit_view([which, &c](ViewOptions& view) {
      open_right(view, c.view_state.columns);
      view.side_tab = which;
    });
  };
  return command;
}

/// A command that switches one kind of comparison with the earlier state on or off.
UserCommand compare(Comparison how, UserCommand command) {
  command.blocked = without_mesh;
  command.checked = [how](const PanelContext& c) { return c.view.comparison == how; };
  command.run = changes([how](ViewOptions& view) {
    view.comparison = view.comparison == how ? Comparison::none : how;
  });
  return command;
}

/// A command that steps through the list of worst elements.
UserCommand worst(int by, UserCommand command) {
  command.blocked = first_of(
      {without_mesh,
       unless([](const PanelContext& c) { return !worst_elements(c.session, c.view).empty(); },
              "The mesh is being measured.")});
  command.run = [by](const PanelContext& c) {
    c.emit(action::GoTo{next_worst(c.session, c.view, c.view_state.focus, by)});
  };
  return command;
}

/// Commands that show the whole mesh or a part of it.
std::vector<UserCommand> fit_commands() {
  return {
      entry("fit", "Fit all", {key('F'), key(GLFW_KEY_HOME)}, "Show the whole mesh.",
            emits(action::FitView{}),
            {.words = "whole mesh zoom extents home", .blocked = without_mesh}),
      entry("fit_bodies", "Fit the bodies", {key('B')},
            "Show all bodies in the mesh, without the far field around them.",
            emits(action::FitBodies{}), {.blocked = without_bodies}),
      entry("fit_selection", "Zoom to selection", {shift(key('F'))}, "Show the selected bodies.",
            emits(action::FitSelection{}),
            {.words = "fit bodies markers",
             .blocked = first_of(
                 {without_mesh,
                  unless([](const PanelContext& c) { return !c.session.selection().empty(); },
                         "Nothing is selected.")})}),
  };
}

/// Commands that move the view.
std::vector<UserCommand> place_commands() {
  return {
      entry("box_zoom", "Zoom to a box", {key('Z')},
            "The next drag of the mouse draws the box to zoom to; Ctrl and the right button do so "
            "at any time.",
            emits(action::BoxZoom{}),
            {.blocked = without_mesh,
             .checked = [](const PanelContext& c) { return c.view_state.box_zoom_armed; }}),
      entry("view_back", "Previous view", {alt(key(GLFW_KEY_LEFT))},
            "Back to where you looked before.", emits(action::BackView{}),
            {.blocked = unless([](const PanelContext& c) { return c.view_state.can_go_back; },
                               "There is no earlier view.")}),
      entry("view_forward", "Next view", {alt(key(GLFW_KEY_RIGHT))},
            "Forward to where you came back from.", emits(action::ForwardView{}),
            {.blocked = unless([](const PanelContext& c) { return c.view_state.can_go_forward; },
                               "There is no later view.")}),
      entry("go_to", "Go to a node or element", {control(key('G'))}, "By its id, or by a point.",
            emits(action::AskGoTo{}), {.blocked = without_mesh}),
      worst(1, entry("next_worst", "Next of the worst elements", {typed(U']')},
                     "Go down the list of the worst elements; at first to the worst.", {})),
      worst(-1, entry("previous_worst", "Previous of the worst elements", {typed(U'[')},
                      "Go up the list of the worst elements.", {})),
  };
}

std::vector<UserCommand> style_commands() {
  return {
      entry("style", "Next style of elements", {key('W')},
            "Surfaces and edges, surfaces alone, edges alone.", changes(step_style),
            {.starts_section = true}),
      toggle(&ViewOptions::nodes,
             entry("nodes", "Nodes", {}, "Draw the nodes as dots.", {}, {.serves = plane_meshes})),
      toggle(&ViewOptions::rim_nodes,
             entry("rim_nodes", "Boundary nodes", {}, "Dots along the boundary.", {},
                   {.serves = plane_meshes})),
      toggle(&ViewOptions::roles,
             entry("roles", "What nodes do", {},
                   "Nodes in colours by what they do while the mesh is smoothed: stay, slide, move "
                   "as one of a periodic pair.",
                   {}, {.words = "sliding periodic feature corner class role"})),
      toggle(&ViewOptions::directions,
             entry("directions", "Boundary directions", {},
                   "Arrows along the boundary, with the mesh on their left.", {},
                   {.serves = plane_meshes})),
      toggle(&ViewOptions::node_ids,
             entry("node_ids", "Node IDs", {shift(key('I'))},
                   "Numbers of the nodes that are far enough apart on screen.", {},
                   {.words = "number label"})),
      toggle(&ViewOptions::element_ids,
             entry("element_ids", "Element IDs", {shift(key('E'))},
                   "Numbers of the elements that are large enough on screen.", {},
                   {.words = "number label"})),
      toggle(
          &ViewOptions::legend,
          entry("legend", "Legend", {key('L')},
                "Show what the colours mean. The mouse drags it to another side or corner.", {})),
      toggle(&ViewOptions::scale_bar, entry("scale_bar", "Scale bar", {},
                                            "A bar of a round length, in units of the mesh.", {})),
  };
}

/// Commands that show more of the same place.
std::vector<UserCommand> detail_commands() {
  return {
      entry("ruler", "Ruler", {key('R')},
            "Measure a distance by two clicks, an angle by three; clicks snap to nodes. Esc puts "
            "it away.",
            emits(action::ToggleRuler{}),
            {.blocked = without_mesh,
             .checked = [](const PanelContext& c) { return c.view_state.ruler; },
             .starts_section = true}),
      entry("isolate", "Isolate elements", {key('I')},
            "Draw the elements beyond a threshold in full, the others faint.",
            changes([](ViewOptions& view) { view.isolation.on = !view.isolation.on; }),
            {.words = "threshold filter bad worst",
             .blocked = first_of(
                 {without_mesh, unless([](const PanelContext& c) { return !!c.view.color; },
                                       "The elements are not coloured by a metric.")}),
             .checked = [](const PanelContext& c) { return c.view.isolation.on; }}),
      entry("magnifier", "Magnifier", {key('M')},
            "A lens under the mouse; the wheel sets its factor. Held down, the key shows it for as "
            "long.",
            changes([](ViewOptions& view) {
              view.magnifier.on = !view.magnifier.on;
              view.magnifier.pin.reset();
            }),
            {.words = "lens zoom loupe",
             .blocked = without_mesh,
             .checked = [](const PanelContext& c) { return c.view.magnifier.on; },
             .serves = plane_meshes}),
      entry("pin_magnifier", "Pin the magnifier here", {shift(key('M'))},
            "An inset that goes on showing the place under the mouse; again: it goes.",
            emits(action::PinMagnifier{}),
            {.blocked = without_mesh,
             .checked = [](const PanelContext& c) { return c.view.magnifier.pin.has_value(); },
             .serves = plane_meshes}),
      compare(Comparison::ghost,
              entry("ghost", "Ghost of previous mesh", {key('G')},
                    "Lay the edges of the state before over the mesh.", {},
                    {.words = "compare before after edges", .starts_section = true})),
      compare(Comparison::split,
              entry("split", "Before and after side by side", {shift(key('G'))},
                    "Left of a divider the state before, right the mesh now.", {})),
  };
}

std::vector<UserCommand> panel_commands() {
  return {
      entry("left", "Bodies and solver", {key(GLFW_KEY_F2)},
            "Open the column on the left, or fold it to icons.",
            [](const PanelContext& c) {
              const ColumnState& columns = c.view_state.columns;
              c.edit_view([&](ViewOptions& view) {
                columns.left_open ? fold_left(view, columns) : open_left(view, columns);
              });
            },
            {.checked = [](const PanelContext& c) { return c.view_state.columns.left_open; },
             .starts_section = true}),
      entry("right", "Quality and history", {key(GLFW_KEY_F3)},
            "Open the column on the right, or fold it to icons.",
            [](const PanelContext& c) {
              const ColumnState& columns = c.view_state.columns;
              c.edit_view([&](ViewOptions& view) {
                columns.right_open ? fold_right(view, columns) : open_right(view, columns);
              });
            },
            {.checked = [](const PanelContext& c) { return c.view_state.columns.right_open; }}),
      toggle(&ViewOptions::plot_panel, entry("plot", "Convergence", {key(GLFW_KEY_F4)},
                                             "Show the plot of the convergence.", {})),
      tab(SideTab::quality,
          entry("tab_quality", "Quality tab", {control(key('1'))},
                "How good the mesh is, in the column on the right.", {}, {.starts_section = true})),
      tab(SideTab::view, entry("tab_view", "View tab", {control(key('2'))},
                               "What is drawn and how, in the column on the right.", {})),
      tab(SideTab::vcv,
          entry("tab_vcv", "VCV tab", {control(key('3'))},
                "A node and its virtual control volume, in the column on the right.", {})),
      tab(SideTab::history, entry("tab_history", "History tab", {control(key('4'))},
                                  "What was done to the mesh, in the column on the right.", {})),
  };
}

std::vector<UserCommand> look_commands() {
  constexpr const char* scaling = "scale zoom text font dpi";
  return {
      entry("dark", "Dark theme", {control(key('D'))}, "Light on dark instead of dark on light.",
            changes([](ViewOptions& view) {
              view.lightness =
                  view.lightness == Lightness::dark ? Lightness::light : Lightness::dark;
            }),
            {.words = "light night colours",
             .checked = [](const PanelContext& c) { return c.view.lightness == Lightness::dark; },
             .starts_section = true}),
      entry("larger", "Larger interface",
            {control(key(GLFW_KEY_EQUAL)), control(key(GLFW_KEY_KP_ADD))},
            "Text and controls one step larger.", emits(action::StepScale{1}), {.words = scaling}),
      entry("smaller", "Smaller interface",
            {control(key(GLFW_KEY_MINUS)), control(key(GLFW_KEY_KP_SUBTRACT))},
            "Text and controls one step smaller.", emits(action::StepScale{-1}),
            {.words = scaling}),
      entry("scale", "Scale of the screen", {control(key('0')), control(key(GLFW_KEY_KP_0))},
            "Text and controls as large as the screen wants them.", emits(action::StepScale{0}),
            {.blocked = unless([](const PanelContext& c) { return c.view.scale > 0; },
                               "This is the scale of the screen.")}),
  };
}

}  // namespace

std::vector<UserCommand> view_commands() {
  std::vector<UserCommand> all;
  for (const auto& part : {fit_commands(), place_commands(), style_commands(), detail_commands(),
                           panel_commands(), look_commands()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

UserCommand::Text while_cuts_are_full() {
  return unless([](const PanelContext& c) { return c.view.space.cuts.size() < most_cuts; },
                "There are six cuts already.");
}

namespace {

/// Commands that look from a direction.
std::vector<UserCommand> directions() {
  constexpr std::array<std::pair<const char*, const char*>, 7> names{{{"+x", "+x"},
                                                                      {"-x", "-x"},
                                                                      {"+y", "+y"},
                                                                      {"-y", "-y"},
                                                                      {"+z", "+z"},
                                                                      {"-z", "-z"},
                                                                      {"iso", "aslant"}}};
  std::vector<UserCommand> all;
  for (const auto& [name, label] : names)
    all.push_back(entry(std::string("look_from/") + name, std::string("Look from ") + label,
                        {key('1' + static_cast<int>(all.size()))},
                        "Look at what is in the middle of the view from there.",
                        emits(action::LookFrom{name}),
                        {.words = "camera direction axis view orbit",
                         .blocked = without_mesh,
                         .serves = meshes_in_space}));
  all.front().starts_section = true;
  return all;
}

}  // namespace

std::vector<UserCommand> space_commands() {
  constexpr const char* cutting = "slice section plane inside clip";
  std::vector<UserCommand> all = directions();
  const std::vector<UserCommand> rest{
      space_toggle(
          &SpaceOptions::perspective,
          entry("perspective", "Perspective", {key('P')},
                "What is nearer is larger; or all is seen parallel.", {},
                {.words = "orthographic parallel projection camera", .serves = meshes_in_space})),
      space_toggle(&SpaceOptions::axes,
                   entry("axes", "Axes", {}, "Where the axes point, in a corner.", {},
                         {.words = "triad", .serves = meshes_in_space})),
      space_toggle(
          &SpaceOptions::free_orbit,
          entry("free_orbit", "Turn freely", {key('T')},
                "The mouse turns the view about any axis; else as on a turntable, on "
                "which the upright axis stays upright.",
                {},
                {.words = "orbit trackball tumble rotate turntable", .serves = meshes_in_space})),
      entry("add_cut", "Add a cut", {key('C')},
            "Cut the mesh through what is in the middle of the view; what lies towards you is "
            "taken away. Its handle moves and turns it.",
            emits(action::AddCutAcrossView{}),
            {.words = cutting,
             .blocked = first_of({without_mesh, while_cuts_are_full()}),
             .serves = volume_meshes}),
      entry("remove_cuts", "Take all cuts away", {shift(key('C'))}, "The mesh is whole again.",
            [](const PanelContext& c) {
              c.emit(action::HoldCut{});
              c.edit_view([](ViewOptions& view) { view.space.cuts.clear(); });
            },
            {.words = cutting,
             .blocked =
                 first_of({without_mesh,
                           unless([](const PanelContext& c) { return !c.view.space.cuts.empty(); },
                                  "There are no cuts.")}),
             .serves = volume_meshes}),
      space_toggle(&SpaceOptions::crinkle,
                   entry("crinkle", "Cuts leave whole elements", {key('K')},
                         "Those of which some part lies behind every cut.", {},
                         {.words = "crinkled slice section", .serves = volume_meshes})),
      space_toggle(&SpaceOptions::worst,
                   entry("worst_through", "Worst elements through the mesh", {},
                         "Draw the elements of the list of worst ones through what hides them.", {},
                         {.words = "bad quality", .serves = meshes_in_space}))};
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

}  // namespace winslow::gui
