#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/menu/bodies.h"
#include "gui/menu/user_command.h"
#include "gui/view/navigation/go_to.h"

namespace winslow::gui {

namespace {

/// A command that turns a part of the view on and off.
UserCommand toggle(bool ViewOptions::*part, UserCommand command) {
  command.group = CommandGroup::view;
  command.checked = [part](const PanelContext& c) { return c.view.*part; };
  command.run = [part](const PanelContext& c) {
    c.edit_view([part](ViewOptions& view) { view.*part = !(view.*part); });
  };
  return command;
}

/// A command that shows a tab of the column on the right.
UserCommand tab(SideTab which, UserCommand command) {
  command.group = CommandGroup::view;
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

/// A command that changes the view.
UserCommand change(void (*how)(ViewOptions&), UserCommand command) {
  command.group = CommandGroup::view;
  command.run = [how](const PanelContext& c) { c.edit_view(how); };
  return command;
}

/// A command that compares with the state before in one way, or no longer.
UserCommand compare(Comparison how, UserCommand command) {
  command.group = CommandGroup::view;
  command.blocked = without_mesh;
  command.checked = [how](const PanelContext& c) { return c.view.comparison == how; };
  command.run = [how](const PanelContext& c) {
    c.edit_view([how](ViewOptions& view) {
      view.comparison = view.comparison == how ? Comparison::none : how;
    });
  };
  return command;
}

/// A command that steps through the list of worst elements.
UserCommand worst(int by, UserCommand command) {
  command.group = CommandGroup::view;
  command.blocked = [](const PanelContext& c) -> std::string {
    if (!c.session.document()) return without_mesh(c);
    return worst_elements(c.session, c.view).empty() ? "The mesh is being measured." : "";
  };
  command.run = [by](const PanelContext& c) {
    c.emit(action::GoTo{next_worst(c.session, c.view, c.view_state.focus, by)});
  };
  return command;
}

/// Commands that look at another place.
std::vector<UserCommand> place_commands() {
  constexpr auto group = CommandGroup::view;
  return {
      {.id = "box_zoom",
       .label = "Zoom to a box",
       .group = group,
       .keys = {key(GLFW_KEY_Z)},
       .tooltip = "The next drag of the mouse draws the box to zoom to; Ctrl and the right button "
                  "do so at any time.",
       .blocked = without_mesh,
       .checked = [](const PanelContext& c) { return c.view_state.box_zoom_armed; },
       .run = [](const PanelContext& c) { c.emit(action::BoxZoom{}); }},
      {.id = "view_back",
       .label = "Previous view",
       .group = group,
       .keys = {alt(key(GLFW_KEY_LEFT))},
       .tooltip = "Back to where you looked before.",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.view_state.can_go_back ? "" : "There is no earlier view.";
       },
       .run = [](const PanelContext& c) { c.emit(action::BackView{}); }},
      {.id = "view_forward",
       .label = "Next view",
       .group = group,
       .keys = {alt(key(GLFW_KEY_RIGHT))},
       .tooltip = "Forward to where you came back from.",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.view_state.can_go_forward ? "" : "There is no later view.";
       },
       .run = [](const PanelContext& c) { c.emit(action::ForwardView{}); }},
      {.id = "go_to",
       .label = "Go to a node or element",
       .group = group,
       .keys = {control(key(GLFW_KEY_G))},
       .tooltip = "By its id, or by a point.",
       .blocked = without_mesh,
       .run = [](const PanelContext& c) { c.emit(action::AskGoTo{}); }},
      worst(1, {.id = "next_worst",
                .label = "Next of the worst elements",
                .keys = {typed(U']')},
                .tooltip = "Go down the list of the worst elements; at first to the worst."}),
      worst(-1, {.id = "previous_worst",
                 .label = "Previous of the worst elements",
                 .keys = {typed(U'[')},
                 .tooltip = "Go up the list of the worst elements."}),
  };
}

UserCommand ruler_command() {
  return {.id = "ruler",
          .label = "Ruler",
          .group = CommandGroup::view,
          .keys = {key(GLFW_KEY_R)},
          .tooltip =
              "Measure a distance by two clicks, an angle by three; clicks snap to nodes. "
              "Esc puts it away.",
          .blocked = without_mesh,
          .checked = [](const PanelContext& c) { return c.view_state.ruler; },
          .run = [](const PanelContext& c) { c.emit(action::ToggleRuler{}); },
          .starts_section = true};
}

/// Commands that show more of the same place.
std::vector<UserCommand> detail_commands() {
  return {
      ruler_command(),
      change([](ViewOptions& view) { view.isolation.on = !view.isolation.on; },
             {.id = "isolate",
              .label = "Isolate elements",
              .keys = {key(GLFW_KEY_I)},
              .tooltip = "Draw the elements beyond a threshold in full, the others faint.",
              .words = "threshold filter bad worst",
              .blocked = [](const PanelContext& c) -> std::string {
                if (!c.session.document()) return without_mesh(c);
                return c.view.color ? "" : "The elements are not coloured by a metric.";
              },
              .checked = [](const PanelContext& c) { return c.view.isolation.on; }}),
      change(
          [](ViewOptions& view) {
            view.magnifier.on = !view.magnifier.on;
            view.magnifier.pin.reset();
          },
          {.id = "magnifier",
           .label = "Magnifier",
           .keys = {key(GLFW_KEY_M)},
           .tooltip = "A lens under the mouse; the wheel sets its factor. Held down, the key "
                      "shows it for as long.",
           .words = "lens zoom loupe",
           .blocked = without_mesh,
           .checked = [](const PanelContext& c) { return c.view.magnifier.on; }}),
      {.id = "pin_magnifier",
       .label = "Pin the magnifier here",
       .group = CommandGroup::view,
       .keys = {shift(key(GLFW_KEY_M))},
       .tooltip = "An inset that goes on showing the place under the mouse; again: it goes.",
       .blocked = without_mesh,
       .checked = [](const PanelContext& c) { return c.view.magnifier.pin.has_value(); },
       .run = [](const PanelContext& c) { c.emit(action::PinMagnifier{}); }},
      compare(Comparison::ghost, {.id = "ghost",
                                  .label = "Ghost of previous mesh",
                                  .keys = {key(GLFW_KEY_G)},
                                  .tooltip = "Lay the edges of the state before over the mesh.",
                                  .words = "compare before after edges",
                                  .starts_section = true}),
      compare(Comparison::split, {.id = "split",
                                  .label = "Before and after side by side",
                                  .keys = {shift(key(GLFW_KEY_G))},
                                  .tooltip = "Left of a divider the state before, right the mesh "
                                             "now."}),
  };
}

std::vector<UserCommand> fit_commands() {
  constexpr auto group = CommandGroup::view;
  return {
      {.id = "fit",
       .label = "Fit all",
       .group = group,
       .keys = {key(GLFW_KEY_F), key(GLFW_KEY_HOME)},
       .tooltip = "Show the whole mesh.",
       .words = "whole mesh zoom extents home",
       .blocked = without_mesh,
       .run = [](const PanelContext& c) { c.emit(action::FitView{}); }},
      {.id = "fit_bodies",
       .label = "Fit the bodies",
       .group = group,
       .keys = {key(GLFW_KEY_B)},
       .tooltip = "Show all bodies in the mesh, without the far field around them.",
       .blocked = without_bodies,
       .run = [](const PanelContext& c) { c.emit(action::FitBodies{}); }},
      {.id = "fit_selection",
       .label = "Zoom to selection",
       .group = group,
       .keys = {shift(key(GLFW_KEY_F))},
       .tooltip = "Show the selected bodies.",
       .words = "fit bodies markers",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.session.document()) return without_mesh(c);
         return c.session.selection().empty() ? "Nothing is selected." : "";
       },
       .run = [](const PanelContext& c) { c.emit(action::FitSelection{}); }},
  };
}

std::vector<UserCommand> style_commands() {
  constexpr auto group = CommandGroup::view;
  return {
      {.id = "style",
       .label = "Next style of elements",
       .group = group,
       .keys = {key(GLFW_KEY_W)},
       .tooltip = "Surfaces and edges, surfaces alone, edges alone.",
       .run = [](const PanelContext& c) { c.edit_view(step_style); },
       .starts_section = true},
      toggle(&ViewOptions::nodes,
             {.id = "nodes", .label = "Nodes", .tooltip = "Draw the nodes as dots."}),
      toggle(&ViewOptions::rim_nodes,
             {.id = "rim_nodes", .label = "Boundary nodes", .tooltip = "Dots along the boundary."}),
      toggle(
          &ViewOptions::roles,
          {.id = "roles",
           .label = "What nodes do",
           .tooltip = "Nodes in colours by what they do while the mesh is smoothed: stay, slide, "
                      "move as one of a periodic pair.",
           .words = "sliding periodic feature corner class role"}),
      toggle(&ViewOptions::directions,
             {.id = "directions",
              .label = "Boundary directions",
              .tooltip = "Arrows along the boundary, with the mesh on their left."}),
      toggle(&ViewOptions::node_ids,
             {.id = "node_ids",
              .label = "Node IDs",
              .keys = {shift(key(GLFW_KEY_I))},
              .tooltip = "Numbers of the nodes that are far enough apart on screen.",
              .words = "number label"}),
      toggle(&ViewOptions::element_ids,
             {.id = "element_ids",
              .label = "Element IDs",
              .keys = {shift(key(GLFW_KEY_E))},
              .tooltip = "Numbers of the elements that are large enough on screen.",
              .words = "number label"}),
      toggle(&ViewOptions::legend, {.id = "legend",
                                    .label = "Legend",
                                    .keys = {key(GLFW_KEY_L)},
                                    .tooltip = "Show what the colours mean. The mouse drags it to "
                                               "another side or corner."}),
      toggle(&ViewOptions::scale_bar,
             {.id = "scale_bar",
              .label = "Scale bar",
              .tooltip = "A bar of a round length, in units of the mesh."}),
  };
}

std::vector<UserCommand> panel_commands() {
  return {
      {.id = "left",
       .label = "Bodies and solver",
       .group = CommandGroup::view,
       .keys = {key(GLFW_KEY_F2)},
       .tooltip = "Open the column on the left, or fold it to icons.",
       .checked = [](const PanelContext& c) { return c.view_state.columns.left_open; },
       .run =
           [](const PanelContext& c) {
             const ColumnState& columns = c.view_state.columns;
             c.edit_view([&](ViewOptions& view) {
               columns.left_open ? fold_left(view, columns) : open_left(view, columns);
             });
           },
       .starts_section = true},
      {.id = "right",
       .label = "Quality and history",
       .group = CommandGroup::view,
       .keys = {key(GLFW_KEY_F3)},
       .tooltip = "Open the column on the right, or fold it to icons.",
       .checked = [](const PanelContext& c) { return c.view_state.columns.right_open; },
       .run =
           [](const PanelContext& c) {
             const ColumnState& columns = c.view_state.columns;
             c.edit_view([&](ViewOptions& view) {
               columns.right_open ? fold_right(view, columns) : open_right(view, columns);
             });
           }},
      toggle(&ViewOptions::plot_panel, {.id = "plot",
                                        .label = "Convergence",
                                        .keys = {key(GLFW_KEY_F4)},
                                        .tooltip = "Show the plot of the convergence."}),
      tab(SideTab::quality, {.id = "tab_quality",
                             .label = "Quality tab",
                             .keys = {control(key(GLFW_KEY_1))},
                             .tooltip = "How good the mesh is, in the column on the right.",
                             .starts_section = true}),
      tab(SideTab::view, {.id = "tab_view",
                          .label = "View tab",
                          .keys = {control(key(GLFW_KEY_2))},
                          .tooltip = "What is drawn and how, in the column on the right."}),
      tab(SideTab::vcv, {.id = "tab_vcv",
                         .label = "VCV tab",
                         .keys = {control(key(GLFW_KEY_3))},
                         .tooltip = "A node and its virtual control volume, in the column on the "
                                    "right."}),
      tab(SideTab::history, {.id = "tab_history",
                             .label = "History tab",
                             .keys = {control(key(GLFW_KEY_4))},
                             .tooltip = "What was done to the mesh, in the column on the right."}),
  };
}

std::vector<UserCommand> look_commands() {
  constexpr auto group = CommandGroup::view;
  return {
      {.id = "dark",
       .label = "Dark theme",
       .group = group,
       .keys = {control(key(GLFW_KEY_D))},
       .tooltip = "Light on dark instead of dark on light.",
       .words = "light night colours",
       .checked = [](const PanelContext& c) { return c.view.lightness == Lightness::dark; },
       .run =
           [](const PanelContext& c) {
             c.edit_view([](ViewOptions& view) {
               view.lightness =
                   view.lightness == Lightness::dark ? Lightness::light : Lightness::dark;
             });
           },
       .starts_section = true},
      {.id = "larger",
       .label = "Larger interface",
       .group = group,
       .keys = {control(key(GLFW_KEY_EQUAL)), control(key(GLFW_KEY_KP_ADD))},
       .tooltip = "Text and controls one step larger.",
       .words = "scale zoom text font dpi",
       .run = [](const PanelContext& c) { c.emit(action::StepScale{1}); }},
      {.id = "smaller",
       .label = "Smaller interface",
       .group = group,
       .keys = {control(key(GLFW_KEY_MINUS)), control(key(GLFW_KEY_KP_SUBTRACT))},
       .tooltip = "Text and controls one step smaller.",
       .words = "scale zoom text font dpi",
       .run = [](const PanelContext& c) { c.emit(action::StepScale{-1}); }},
      {.id = "scale",
       .label = "Scale of the screen",
       .group = group,
       .keys = {control(key(GLFW_KEY_0)), control(key(GLFW_KEY_KP_0))},
       .tooltip = "Text and controls as large as the screen wants them.",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.view.scale > 0 ? "" : "This is the scale of the screen.";
       },
       .run = [](const PanelContext& c) { c.emit(action::StepScale{0}); }},
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

namespace {

/// A command that looks from a direction.
UserCommand look_from(const char* name, int key_code, const char* label) {
  return {.id = std::string("look_from/") + name,
          .label = label,
          .group = CommandGroup::view,
          .keys = {key(key_code)},
          .tooltip = "Look at what is in the middle of the view from there.",
          .words = "camera direction axis view orbit",
          .blocked = without_mesh,
          .run = [name](const PanelContext& c) { c.emit(action::LookFrom{name}); }};
}

/// A command that turns a part of how space is seen on and off.
UserCommand space_toggle(bool SpaceOptions::*part, UserCommand command) {
  command.group = CommandGroup::view;
  command.blocked = without_mesh;
  command.checked = [part](const PanelContext& c) { return c.view.space.*part; };
  command.run = [part](const PanelContext& c) {
    c.edit_view([part](ViewOptions& view) { view.space.*part = !(view.space.*part); });
  };
  return command;
}

UserCommand add_cut() {
  return {.id = "add_cut",
          .label = "Add a cut",
          .group = CommandGroup::view,
          .keys = {key(GLFW_KEY_C)},
          .tooltip =
              "Cut the mesh through what is in the middle of the view; what lies towards you "
              "is taken away. Its handle moves and turns it.",
          .words = "slice section plane inside clip",
          .blocked = [](const PanelContext& c) -> std::string {
            if (std::string reason = without_mesh(c); !reason.empty()) return reason;
            return c.view.space.cuts.size() < most_cuts ? "" : "There are six cuts already.";
          },
          .run = [](const PanelContext& c) { c.emit(action::AddCutAcrossView{}); }};
}

UserCommand remove_cuts() {
  return {.id = "remove_cuts",
          .label = "Take all cuts away",
          .group = CommandGroup::view,
          .keys = {shift(key(GLFW_KEY_C))},
          .tooltip = "The mesh is whole again.",
          .words = "slice section plane inside clip",
          .blocked = [](const PanelContext& c) -> std::string {
            if (std::string reason = without_mesh(c); !reason.empty()) return reason;
            return c.view.space.cuts.empty() ? "There are no cuts." : "";
          },
          .run =
              [](const PanelContext& c) {
                c.emit(action::HoldCut{});
                c.edit_view([](ViewOptions& view) { view.space.cuts.clear(); });
              }};
}

}  // namespace

std::vector<UserCommand> space_commands() {
  std::vector<UserCommand> all{
      look_from("+x", GLFW_KEY_1, "Look from +x"),     look_from("-x", GLFW_KEY_2, "Look from -x"),
      look_from("+y", GLFW_KEY_3, "Look from +y"),     look_from("-y", GLFW_KEY_4, "Look from -y"),
      look_from("+z", GLFW_KEY_5, "Look from +z"),     look_from("-z", GLFW_KEY_6, "Look from -z"),
      look_from("iso", GLFW_KEY_7, "Look from aslant")};
  all.front().starts_section = true;
  all.push_back(space_toggle(&SpaceOptions::perspective,
                             {.id = "perspective",
                              .label = "Perspective",
                              .keys = {key(GLFW_KEY_P)},
                              .tooltip = "What is nearer is larger; or all is seen parallel.",
                              .words = "orthographic parallel projection camera"}));
  all.push_back(space_toggle(&SpaceOptions::axes, {.id = "axes",
                                                   .label = "Axes",
                                                   .tooltip = "Where the axes point, in a corner.",
                                                   .words = "triad"}));
  all.push_back(space_toggle(
      &SpaceOptions::free_orbit,
      {.id = "free_orbit",
       .label = "Turn freely",
       .keys = {key(GLFW_KEY_T)},
       .tooltip = "The mouse turns the view about any axis; else as on a turntable, on which the "
                  "upright axis stays upright.",
       .words = "orbit trackball tumble rotate turntable"}));
  all.push_back(add_cut());
  all.push_back(remove_cuts());
  all.push_back(space_toggle(&SpaceOptions::crinkle,
                             {.id = "crinkle",
                              .label = "Cuts leave whole elements",
                              .keys = {key(GLFW_KEY_K)},
                              .tooltip = "Those of which some part lies behind every cut.",
                              .words = "crinkled slice section"}));
  all.push_back(space_toggle(
      &SpaceOptions::worst,
      {.id = "worst_through",
       .label = "Worst elements through the mesh",
       .tooltip = "Draw the elements of the list of worst ones through what hides them.",
       .words = "bad quality"}));
  for (UserCommand& command : all) {
    const bool cuts =
        command.id == "add_cut" || command.id == "remove_cuts" || command.id == "crinkle";
    command.serves = cuts ? volume_meshes : meshes_in_space;
  }
  return all;
}

}  // namespace winslow::gui
