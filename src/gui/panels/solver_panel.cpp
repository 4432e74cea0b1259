#include "gui/panels/solver_panel.h"

#include <algorithm>
#include <array>

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

/// A choice among the values of an enumeration, by their order.
template <typename Enum>
bool choose_value(const char* id, const char* label, const std::vector<std::string>& names,
                  Enum& value, std::string_view tip) {
  ui::row(label, tip);
  auto chosen = static_cast<std::size_t>(value);
  if (!ui::combo(id, names, chosen, tip)) return false;
  value = static_cast<Enum>(chosen);
  return true;
}

struct NamedTargets {
  const char* name;
  TargetBlend blend;
};
const std::array<NamedTargets, 3> pure_targets{
    {{"Regular elements", {1, 0, 0}}, {"VCV stencils", {0, 1, 0}}, {"Rest mesh", {0, 0, 1}}}};

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
    ui::text_colored(palette().danger, counted(last.inverted, "inverted element"));
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

bool SolverPanel::draw_variational(SmoothOptions& options) {
  bool changed = false;
  constexpr const char* targets_tip =
      "The shape that every element is driven towards.\n"
      "Regular elements: equilateral triangles, square quadrilaterals; the best worst cells.\n"
      "VCV stencils: the angles and edge lengths of the virtual control volumes.\n"
      "Rest mesh: each element's own shape as it was before the motion, to keep a graded or "
      "stretched mesh as it is.";
  ui::row("Targets", targets_tip);
  std::vector<std::string> names;
  std::size_t chosen = pure_targets.size();
  for (std::size_t i = 0; i < pure_targets.size(); ++i) {
    names.emplace_back(pure_targets[i].name);
    if (options.targets == pure_targets[i].blend) chosen = i;
  }
  if (chosen == names.size()) names.emplace_back("Blend");
  if (ui::combo("solver/targets", names, chosen, targets_tip) && chosen < pure_targets.size()) {
    options.targets = pure_targets[chosen].blend;
    changed = true;
  }
  constexpr const char* exponent_tip =
      "How much more the worst elements count than the average ones. 1: all alike; larger: better "
      "worst cells.";
  ui::row("Exponent", exponent_tip);
  changed |= ui::number("solver/exponent", options.penalty.exponent, exponent_tip, "%g");
  constexpr const char* knee_tip =
      "Distortion (1 is perfect) at which the penalty begins to bite; 0: everywhere.";
  ui::row("Knee", knee_tip);
  changed |= ui::number("solver/knee", options.penalty.knee, knee_tip, "%g");
  changed |= choose_value("solver/untangle", "Untangling", {"Automatic", "Fixed point", "Energy"},
                          options.untangle,
                          "How a tangled mesh is untangled before Newton's method begins.\n"
                          "Fixed point: the paper's damped iteration. Energy: a regularised "
                          "determinant. Automatic: the one, then the other.");
  return changed;
}

bool SolverPanel::draw_pointwise(SmoothOptions& options) {
  bool changed = choose_value(
      "solver/outer", "Iteration", {"Automatic", "Newton", "Fixed point"}, options.outer,
      "How the equations are solved. Fixed point: the paper's damped outer iteration. Newton: "
      "quadratic close to the solution. Automatic: Newton, then the fixed point where it fails.");
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
  changed |=
      choose_value("solver/clip", "Clip weights", {"Automatic", "Always", "Never"}, options.clip,
                   "Whether negative weights of the operator are set to zero. Automatic: "
                   "while the mesh is tangled.");
  return changed;
}

bool SolverPanel::draw_options(SmoothOptions& options) {
  bool changed = false;
  constexpr const char* formulation_tip =
      "The equations solved over the virtual control volumes.\n"
      "variational: an energy with a barrier against inversion; Newton's method through valid "
      "meshes only. The default.\n"
      "pointwise: the paper's operator, node by node.";
  ui::row("Formulation", formulation_tip);
  changed |=
      choose("solver/formulation", formulation_names(), options.formulation, formulation_tip);
  const std::string tip = linear_tip();
  ui::row("Linear solver", tip);
  changed |= choose("solver/linear", linear_solver_names(), options.linear.solver, tip);

  changed |=
      options.formulation == "variational" ? draw_variational(options) : draw_pointwise(options);
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
