#include "gui/panels/solver_panel.h"

#include <algorithm>

#include "core/formulation/formulation.h"
#include "gui/studio/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

bool choose(const char* id, const std::vector<std::string>& names, std::string& value,
            std::string_view tip) {
  const auto it = std::find(names.begin(), names.end(), value);
  auto chosen = static_cast<std::size_t>(it - names.begin());
  if (!ui::combo(id, names, chosen, tip)) return false;
  value = names[chosen];
  return true;
}

std::string linear_tip() {
  std::string text = "How each linear system is solved. The converged mesh is the same.";
  for (const auto& name : linear_solver_names())
    text += "\n" + name + ": " + std::string(linear_solver_summary(name));
  return text;
}

}  // namespace

void SolverPanel::draw(const PanelContext& context) {
  if (!ui::section("section/solver", "Solver")) return;
  draw_state(context);
  draw_buttons(context);
  SmoothOptions options = context.session.smooth_options();
  ImGui::BeginDisabled(context.session.job().active());
  if (draw_options(options)) context.emit(action::SetSmoothOptions{options});
  ImGui::EndDisabled();
}

void SolverPanel::draw_state(const PanelContext& context) {
  const JobRunner& job = context.session.job();
  if (!job.active()) {
    ui::text_dim("Idle");
    return;
  }
  ui::text_wrapped((job.paused() ? "Paused: " : "") + describe(job.command()));
  const auto history = context.session.convergence();
  if (history.empty()) {
    ui::text_dim("starting");
    return;
  }
  const IterationRecord& last = history.back();
  ui::text_dim("iteration " + std::to_string(last.iteration) + ", residual " +
               short_number(last.residual));
  if (last.inverted > 0)
    ui::text_colored(color::danger, counted(last.inverted, "inverted element"));
}

void SolverPanel::draw_buttons(const PanelContext& context) {
  const JobRunner& job = context.session.job();
  const bool open = context.session.document() != nullptr;
  const bool dragging = context.session.dragging();
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  if (job.active() && !job.paused()) {
    if (ui::button("solver/pause", "Pause",
                   {"Stop after the present iteration (Space).", ui::ButtonStyle::normal, !dragging,
                    width}))
      context.emit(action::PauseSolver{});
  } else if (ui::button("solver/run", job.paused() ? "Resume" : "Smooth",
                        {"Smooth the mesh, its boundary held (Space).", ui::ButtonStyle::primary,
                         open, width})) {
    context.emit(action::RunSmooth{});
  }
  ImGui::SameLine(0, gap);
  if (ui::button("solver/step", "Step",
                 {"One outer iteration, then pause (N).", ui::ButtonStyle::normal,
                  open && !dragging, width}))
    context.emit(action::StepSolver{1});
  ImGui::SameLine(0, gap);
  if (ui::button("solver/cancel", "Cancel",
                 {"Stop and put the mesh back as it was (Esc).", ui::ButtonStyle::normal,
                  job.active(), width}))
    context.emit(action::CancelSolver{});
}

bool SolverPanel::draw_options(SmoothOptions& options) {
  bool changed = false;
  constexpr const char* formulation_tip = "The equations solved over the virtual control volumes.";
  ui::row("Formulation", formulation_tip);
  changed |=
      choose("solver/formulation", formulation_names(), options.formulation, formulation_tip);
  const std::string tip = linear_tip();
  ui::row("Linear solver", tip);
  changed |= choose("solver/linear", linear_solver_names(), options.linear.solver, tip);

  constexpr const char* damping_tip =
      "Share of each linear solution that is taken. Smaller is safer and slower.";
  ui::row("Damping", damping_tip);
  auto damping = static_cast<float>(options.damping);
  if (ImGui::SliderFloat("##damping", &damping, 0.05f, 1.0f, "%.2f",
                         ImGuiSliderFlags_AlwaysClamp)) {
    options.damping = static_cast<double>(damping);
    changed = true;
  }
  ui::note("solver/damping");
  ui::tooltip(damping_tip);

  constexpr const char* clip_tip =
      "Whether negative weights of the operator are set to zero. Automatic: while the mesh is "
      "tangled.";
  ui::row("Clip weights", clip_tip);
  auto clip = static_cast<std::size_t>(options.clip);
  if (ui::combo("solver/clip", {"Automatic", "Always", "Never"}, clip, clip_tip)) {
    options.clip = static_cast<Clip>(clip);
    changed = true;
  }
  constexpr const char* iterations_tip = "Outer iterations after which the solver gives up.";
  ui::row("Max. iterations", iterations_tip);
  changed |= ui::number("solver/max_iterations", options.max_iterations, iterations_tip);
  constexpr const char* tolerance_tip =
      "Converged when the largest scaled residual is below this: the green line in the plot.";
  ui::row("Tolerance", tolerance_tip);
  changed |= ui::number("solver/tolerance", options.tolerance, tolerance_tip, "%.1e");
  return changed;
}

}  // namespace winslow::gui
