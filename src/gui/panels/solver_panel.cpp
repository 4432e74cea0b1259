#include "gui/panels/panels.h"

#include "gui/base/text.h"
#include "gui/document/jobs/run_settings.h"
#include "gui/document/session/session.h"
#include "gui/panels/forms/option_form.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// The labels' share in rows with short labels and long list entries.
constexpr float solver_label_share = 0.3f;

/// Options of smoothing, and buttons to run, pause, step, cancel and undo.
class SolverPanel {
 public:
  void draw(const PanelContext& context) {
    if (!ui::section("section/solver", "Solver")) return;
    // Options for moving boundaries, which a surface mesh does not have.
    if (context.session.kind() != MeshKind::surface) {
      draw_method(context);
      draw_pace(context);
    }
    draw_state(context);
    draw_steps(context);
    draw_resets(context);
    draw_options(context);
  }

 private:
  void draw_method(const PanelContext& context) {
    const Session& session = context.session;
    SmoothOptions smooth = session.solver_settings().smooth_options();
    MotionOptions motion = session.solver_settings().motion_options();
    ImGui::BeginDisabled(session.job().active());
    if (ui::method_choice("solver", smooth, motion, solver_label_share)) {
      context.edit(smooth);
      context.edit(motion);
    }
    ImGui::EndDisabled();
  }

  /// Draws the pace, which remains enabled while the solver runs.
  void draw_pace(const PanelContext& context) {
    const Session& session = context.session;
    if (method_of(session.solver_settings().smooth_options(),
                  session.solver_settings().motion_options()) != Method::direct)
      return;
    static constexpr std::array<ui::Named<double>, 6> rates{{{1, "1 a second"},
                                                             {2, "2 a second"},
                                                             {5, "5 a second"},
                                                             {10, "10 a second"},
                                                             {30, "30 a second"},
                                                             {0, "Unlimited"}}};
    double pace = session.jobs().pace();
    if (ui::choice("solver/pace", "Iterations", rates, pace,
                   "How many outer iterations a second are carried out and shown. Slow enough to "
                   "watch the mesh untangle; Unlimited when only the result matters. It can be "
                   "changed while the solver runs.",
                   solver_label_share, rates.size() - 1))
      context.emit(action::SetPace{pace});
  }

  void draw_state(const PanelContext& context) {
    const JobRunner& job = context.session.job();
    if (!job.active()) {
      const Activity activity = activity_of(context.session);
      ui::text_wrapped(activity.kind == Activity::Kind::idle ? "Idle" : activity.text);
      ui::note("solver/state");
      ui::tooltip("Smooth, Step and Cancel are in the toolbar.");
      return;
    }
    ui::text_wrapped((job.paused() ? "Paused: " : "") + describe(job.command()));
    const auto history = context.session.mesh().convergence();
    if (history.empty()) return ui::text_dim("starting");
    const IterationRecord& last = history.back();
    ui::text_dim("iteration " + std::to_string(last.iteration) + ", residual " +
                 short_number(last.residual));
    if (last.inverted > 0)
      ui::text_colored(palette().danger, counted(last.inverted, "inverted element"));
  }

  void draw_steps(const PanelContext& context) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    constexpr const char* tip = "How many outer iterations the button beside it runs.";
    ImGui::SetNextItemWidth(width);
    ui::number("solver/steps", steps_, tip);
    steps_ = std::clamp(steps_, 1, 1000000);
    ImGui::SameLine(0, gap);
    if (ui::button(
            "solver/step_n", "Step " + grouped(steps_),
            {"That many outer iterations, then pause. Use it to look at the mesh on its way.",
             ui::ButtonStyle::normal, context.session.document() && !context.session.dragging(),
             -1}))
      context.emit(action::StepSolver{steps_});
  }

  void draw_resets(const PanelContext& context) {
    const Document* document = context.session.document();
    const bool active = context.session.job().active();
    const bool surface = context.session.kind() == MeshKind::surface;
    if (ui::button(
            "solver/reset_motion", surface ? "Before last command" : "Before motion",
            {"Back to the mesh before this command: cancels the one under way, or takes back the "
             "last one. Redo brings that back.",
             ui::ButtonStyle::normal, document && (active || document->history().can_undo()), -1}))
      context.emit(action::Undo{});
    if (ui::button("solver/reset_loaded", "Revert to opened mesh",
                   {"Back to the mesh as it was opened. The history keeps the commands (Ctrl+R).",
                    ui::ButtonStyle::normal,
                    document && (active || document->history().position() > 0), -1}))
      context.emit(action::GoToStep{0});
  }

  void draw_options(const PanelContext& context) {
    if (!ui::fold("solver/advanced", "Advanced",
                  context.session.kind() == MeshKind::surface
                      ? "Targets, penalty, linear solver, tolerance. The defaults need no touch. "
                        "The pointwise form, the fixed point and regions that are kept are not for "
                        "surface meshes."
                      : "Equations, damping, clipping, linear solver, tolerance. The defaults need "
                        "no touch."))
      return;
    ImGui::BeginDisabled(context.session.job().active());
    SmoothOptions options = context.session.solver_settings().smooth_options();
    if (ui::smooth_options_form("solver", options, context.session.kind())) context.edit(options);
    if (ui::button("solver/defaults", "Reset to defaults",
                   {"Method and options as they were when the studio was first started.",
                    ui::ButtonStyle::normal, true, -1})) {
      context.emit(action::EditSmoothOptions{whole(SmoothOptions())});
      context.emit(action::EditMotionOptions{whole(MotionOptions())});
      context.emit(action::SetPace{default_pace});
    }
    ImGui::EndDisabled();
  }

  int steps_ = 10;
};

}  // namespace

DrawPanel solver_panel() { return panel_of<SolverPanel>(); }

}  // namespace winslow::gui
