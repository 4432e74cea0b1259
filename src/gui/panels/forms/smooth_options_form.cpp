#include "gui/panels/forms/smooth_options_form.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/formulation/formulation.h"
#include "gui/document/jobs/method.h"
#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

namespace {

struct NamedTargets {
  const char* name;
  TargetBlend blend;
};
const std::array<NamedTargets, 3> pure_targets{
    {{"Regular elements", {1, 0, 0}}, {"VCV stencils", {0, 1, 0}}, {"Rest mesh", {0, 0, 1}}}};

bool by_fixed_point(const SmoothOptions& o) { return o.outer == OuterMethod::picard; }

/// The rows of one form.
class SmoothForm {
 public:
  SmoothForm(const std::string& prefix, SmoothOptions& options)
      : prefix_(prefix), options_(options) {}

  bool draw() {
    equations();
    if (options_.formulation == "variational") targets();
    if (!by_fixed_point(options_)) untangling();
    if (uses_fixed_point()) fixed_point();
    linear_solver();
    limits();
    return changed_;
  }

 private:
  /// Also where Newton's method has the fixed point untangle for it, or stand in for it.
  bool uses_fixed_point() const {
    return options_.outer == OuterMethod::picard || options_.untangle != Untangle::energy ||
           (options_.formulation != "variational" && options_.outer == OuterMethod::automatic);
  }

  void equations() {
    constexpr const char* tip =
        "The equations solved over the virtual control volumes.\n"
        "variational: an energy with a barrier against inversion; Newton's method through valid "
        "meshes only. The default.\n"
        "pointwise: the paper's operator, node by node. For comparison with the paper.";
    if (choose("formulation", "Formulation", formulation_names(), options_.formulation, tip)) {
      if (options_.formulation == "variational" && by_fixed_point(options_))
        options_.outer = OuterMethod::automatic;
      mend_linear_solver(options_);
    }
    if (options_.formulation == "variational") return;
    choose_value("outer", "Iteration", {"Automatic", "Newton", "Fixed point"}, options_.outer,
                 "How the equations are solved. Fixed point: the paper's damped outer iteration. "
                 "Newton: quadratic close to the solution. Automatic: Newton, then the fixed point "
                 "where it fails.");
  }

  void targets() {
    constexpr const char* tip =
        "The shape that every element is driven towards.\n"
        "Regular elements: equilateral triangles, square quadrilaterals; the best worst cells.\n"
        "VCV stencils: the angles and edge lengths of the virtual control volumes. Choose it "
        "after editing those.\n"
        "Rest mesh: each element's own shape as it was before the motion, to keep a graded or "
        "stretched mesh as it is.";
    std::vector<std::string> names;
    std::size_t chosen = pure_targets.size();
    for (std::size_t i = 0; i < pure_targets.size(); ++i) {
      names.emplace_back(pure_targets[i].name);
      if (options_.targets == pure_targets[i].blend) chosen = i;
    }
    if (chosen == names.size()) names.emplace_back("Blend");
    row("Targets", tip);
    if (combo(id("targets"), names, chosen, tip) && chosen < pure_targets.size()) {
      options_.targets = pure_targets[chosen].blend;
      changed_ = true;
    }
    field("exponent", "Exponent", options_.penalty.exponent, "%g",
          "How much more the worst elements count than the average ones. 1: all alike; larger: "
          "better worst cells, at the price of more iterations.");
    field("knee", "Knee", options_.penalty.knee, "%g",
          "Distortion (1 is perfect) at which the penalty begins to bite; 0: everywhere. Raise it "
          "to let well-shaped elements alone.");
  }

  void untangling() {
    choose_value("untangle", "Untangling", {"Automatic", "Fixed point", "Energy"},
                 options_.untangle,
                 "How a tangled mesh is untangled before Newton's method begins.\n"
                 "Fixed point: the paper's damped iteration. Energy: a regularised determinant. "
                 "Automatic: the one, then the other. Choose one of them if the other wastes "
                 "time.");
  }

  void fixed_point() {
    constexpr const char* damping =
        "Share of each linear solution that the fixed point takes. Smaller is safer and slower: "
        "lower it where the iteration swings or the mesh does not untangle.";
    row("Damping", damping);
    auto value = static_cast<float>(options_.damping);
    if (ImGui::SliderFloat(("##" + id("damping")).c_str(), &value, 0.05f, 1.0f, "%.2f",
                           ImGuiSliderFlags_AlwaysClamp)) {
      options_.damping = static_cast<double>(value);
      changed_ = true;
    }
    note(id("damping"));
    tooltip(damping);
    row("");
    changed_ |= checkbox(id("adapt"), "Adapt the damping", options_.adapt_damping,
                         "Halve the damping where the iteration makes no progress. Off: the same "
                         "all through, as in the paper.");
    choose_value("clip", "Clip weights", {"Automatic", "Always", "Never"}, options_.clip,
                 "Whether negative weights of the operator are set to zero: without them no node "
                 "is drawn out of its neighbours. Automatic: while the mesh is tangled.");
    if (options_.formulation == "variational" || options_.outer == OuterMethod::newton) return;
    field("acceleration", "Acceleration", options_.acceleration,
          "Earlier iterates that Anderson acceleration combines once the mesh is valid. 0: the "
          "plain iteration of the paper, which takes many more iterations.");
  }

  void linear_solver() {
    std::vector<std::string> names;
    std::string tip = "How each linear system is solved. The converged mesh is the same.";
    for (const std::string& name : linear_solver_names()) {
      if (options_.formulation != "variational" && linear_solver_needs_symmetry(name)) continue;
      names.push_back(name);
      tip += "\n" + name + ": " + std::string(linear_solver_summary(name));
    }
    choose("linear", "Linear solver", names, options_.linear.solver, tip);
    const std::string& solver = options_.linear.solver;
    if (solver == "automatic" || solver == "direct") return;
    field("linear_tolerance", "Its tolerance", options_.linear.tolerance, "%.1e",
          "Relative residual at which the linear solver stops. The outer iteration corrects what "
          "is left; tighten it only if outer iterations stall.");
    field("linear_iterations", "Its iterations", options_.linear.max_iterations,
          "Most sweeps or Krylov iterations for one linear system.");
    if (solver == "gmres")
      field("restart", "Restart", options_.linear.restart,
            "Vectors that GMRES keeps before it starts anew. More: fewer iterations, more memory.");
  }

  void limits() {
    field("max_iterations", "Max. iterations", options_.max_iterations,
          "Outer iterations after which the solver gives up. Raise it if a run ends valid but not "
          "converged.");
    field("tolerance", "Tolerance", options_.tolerance, "%.1e",
          "Converged when the largest scaled residual is below this: the green line in the plot. "
          "1e-4 is enough for the eye.");
    field("threads", "Threads", options_.threads,
          "0: all cores. The result does not depend on it.");
  }

  std::string id(const char* name) const { return prefix_ + '/' + name; }

  void field(const char* name, const char* label, double& value, const char* format,
             std::string_view tip) {
    row(label, tip);
    changed_ |= number(id(name), value, tip, format);
  }

  void field(const char* name, const char* label, int& value, std::string_view tip) {
    row(label, tip);
    changed_ |= number(id(name), value, tip);
  }

  bool choose(const char* name, const char* label, const std::vector<std::string>& names,
              std::string& value, std::string_view tip) {
    row(label, tip);
    auto chosen =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), value) - names.begin());
    if (!combo(id(name), names, chosen, tip)) return false;
    value = names[chosen];
    changed_ = true;
    return true;
  }

  /// A choice among the values of an enumeration, by their order.
  template <typename Enum>
  void choose_value(const char* name, const char* label, const std::vector<std::string>& names,
                    Enum& value, std::string_view tip) {
    row(label, tip);
    auto chosen = static_cast<std::size_t>(value);
    if (!combo(id(name), names, chosen, tip)) return;
    value = static_cast<Enum>(chosen);
    changed_ = true;
  }

  const std::string& prefix_;
  SmoothOptions& options_;
  bool changed_ = false;
};

}  // namespace

bool method_choice(const std::string& prefix, SmoothOptions& smooth, MotionOptions& motion) {
  constexpr const char* tip =
      "Path following: the mesh follows the moving boundary through valid meshes only. The "
      "default; change nothing unless you want to see the other.\n"
      "Direct: the paper's outer iteration. The boundary goes to its place at once, which tangles "
      "the mesh, and the iteration untangles it. Every iteration is shown.";
  std::vector<std::string> names{"Path following", "Direct (the paper's)"};
  auto chosen = static_cast<std::size_t>(method_of(smooth, motion));
  if (chosen == names.size()) names.emplace_back("Custom (see Advanced)");
  row("Method", tip);
  if (!combo(prefix + "/method", names, chosen, tip)) return false;
  use_method(static_cast<Method>(chosen), smooth, motion);
  return true;
}

bool smooth_options_form(const std::string& prefix, SmoothOptions& options) {
  return SmoothForm(prefix, options).draw();
}

}  // namespace winslow::gui::ui
