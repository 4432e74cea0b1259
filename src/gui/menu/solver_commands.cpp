#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/menu/user_command.h"

namespace winslow::gui {

namespace {

bool at_work(const PanelContext& context) {
  return context.session.job().active() && !context.session.job().paused();
}

std::string while_dragging(const PanelContext& context) {
  if (!context.session.document()) return without_mesh(context);
  return context.session.dragging() ? "A body is being dragged." : "";
}

}  // namespace

std::vector<UserCommand> solver_commands() {
  constexpr auto group = CommandGroup::solver;
  return {
      {.id = "run",
       .label = "Smooth",
       .group = group,
       .keys = {key(GLFW_KEY_SPACE)},
       .tooltip = "Smooth the mesh, its boundary held; goes on where the solver is paused.",
       .words = "solve run start untangle repair optimise winslow",
       .blocked =
           [](const PanelContext& c) {
             return at_work(c) ? "The solver is at work." : without_mesh(c);
           },
       .run = [](const PanelContext& c) { c.emit(action::RunSmooth{}); },
       .label_now = [](const PanelContext& c) -> std::string {
         return c.session.job().paused() ? "Resume" : "Smooth";
       }},
      {.id = "pause",
       .label = "Pause",
       .group = group,
       .keys = {key(GLFW_KEY_SPACE)},
       .tooltip = "Stop after this iteration.",
       .blocked =
           [](const PanelContext& c) {
             return at_work(c) ? while_dragging(c) : "The solver is not at work.";
           },
       .run = [](const PanelContext& c) { c.emit(action::PauseSolver{}); }},
      {.id = "step",
       .label = "Single step",
       .group = group,
       .keys = {key(GLFW_KEY_N)},
       .tooltip = "One outer iteration, then pause.",
       .blocked = while_dragging,
       .run = [](const PanelContext& c) { c.emit(action::StepSolver{1}); }},
      {.id = "step10",
       .label = "Ten steps",
       .group = group,
       .keys = {shift(key(GLFW_KEY_N))},
       .tooltip = "Ten outer iterations, then pause.",
       .blocked = while_dragging,
       .run = [](const PanelContext& c) { c.emit(action::StepSolver{10}); }},
      {.id = "cancel",
       .label = "Cancel",
       .group = group,
       .keys = {key(GLFW_KEY_ESCAPE)},
       .tooltip = "Stop and put the mesh back as it was.",
       .words = "abort stop",
       .blocked = [](const PanelContext& c) -> std::string {
         return c.session.job().active() ? "" : "The solver is not at work.";
       },
       .run = [](const PanelContext& c) { c.emit(action::CancelSolver{}); }},
  };
}

}  // namespace winslow::gui
