#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/commands/user_command.h"

namespace winslow::gui {

namespace {

/// A command that turns a part of the view on and off.
UserCommand toggle(bool ViewOptions::*part, UserCommand command) {
  command.group = CommandGroup::view;
  command.checked = [part](const PanelContext& c) { return c.view.*part; };
  command.run = [part](const PanelContext& c) {
    ViewOptions view = c.view;
    view.*part = !(view.*part);
    c.emit(action::SetView{view});
  };
  return command;
}

/// A command that shows a tab of the column on the right.
UserCommand tab(SideTab which, UserCommand command) {
  command.group = CommandGroup::view;
  command.checked = [which](const PanelContext& c) {
    return c.view.right_panel && c.view.side_tab == which;
  };
  command.run = [which](const PanelContext& c) {
    ViewOptions view = c.view;
    view.right_panel = true;
    view.side_tab = which;
    c.emit(action::SetView{view});
  };
  return command;
}

}  // namespace

std::vector<UserCommand> view_commands() {
  constexpr auto group = CommandGroup::view;
  return {
      {.id = "fit",
       .label = "Fit the whole mesh",
       .group = group,
       .keys = {key(GLFW_KEY_F)},
       .tooltip = "Show the whole mesh.",
       .blocked = without_mesh,
       .run = [](const PanelContext& c) { c.emit(action::FitView{}); }},
      {.id = "fit_selection",
       .label = "Fit the selection",
       .group = group,
       .keys = {shift(key(GLFW_KEY_F))},
       .tooltip = "Show the selected bodies.",
       .blocked = [](const PanelContext& c) -> std::string {
         if (!c.session.document()) return without_mesh(c);
         return c.session.selection().empty() ? "Nothing is selected." : "";
       },
       .run = [](const PanelContext& c) { c.emit(action::FitSelection{}); }},
      {.id = "style",
       .label = "Next style of elements",
       .group = group,
       .keys = {key(GLFW_KEY_W)},
       .tooltip = "Surfaces and edges, surfaces alone, edges alone.",
       .run =
           [](const PanelContext& c) {
             ViewOptions view = c.view;
             step_style(view);
             c.emit(action::SetView{view});
           },
       .starts_section = true},
      toggle(&ViewOptions::nodes,
             {.id = "nodes", .label = "Nodes", .tooltip = "Draw the nodes as dots."}),
      toggle(&ViewOptions::legend, {.id = "legend",
                                    .label = "Legend",
                                    .keys = {key(GLFW_KEY_L)},
                                    .tooltip = "Show what the colours mean."}),
      toggle(&ViewOptions::left_panel, {.id = "left",
                                        .label = "Bodies and solver",
                                        .keys = {key(GLFW_KEY_F2)},
                                        .tooltip = "Show the column on the left.",
                                        .starts_section = true}),
      toggle(&ViewOptions::right_panel, {.id = "right",
                                         .label = "Quality and history",
                                         .keys = {key(GLFW_KEY_F3)},
                                         .tooltip = "Show the column on the right."}),
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
      tab(SideTab::history, {.id = "tab_history",
                             .label = "History tab",
                             .keys = {control(key(GLFW_KEY_3))},
                             .tooltip = "What was done to the mesh, in the column on the right."}),
      {.id = "dark",
       .label = "Dark theme",
       .group = group,
       .keys = {control(key(GLFW_KEY_D))},
       .tooltip = "Light on dark instead of dark on light.",
       .checked = [](const PanelContext& c) { return c.view.lightness == Lightness::dark; },
       .run =
           [](const PanelContext& c) {
             ViewOptions view = c.view;
             view.lightness =
                 view.lightness == Lightness::dark ? Lightness::light : Lightness::dark;
             c.emit(action::SetView{view});
           },
       .starts_section = true},
      {.id = "larger",
       .label = "Larger interface",
       .group = group,
       .keys = {control(key(GLFW_KEY_EQUAL)), control(key(GLFW_KEY_KP_ADD))},
       .tooltip = "Text and controls one step larger.",
       .run = [](const PanelContext& c) { c.emit(action::StepScale{1}); }},
      {.id = "smaller",
       .label = "Smaller interface",
       .group = group,
       .keys = {control(key(GLFW_KEY_MINUS)), control(key(GLFW_KEY_KP_SUBTRACT))},
       .tooltip = "Text and controls one step smaller.",
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

}  // namespace winslow::gui
