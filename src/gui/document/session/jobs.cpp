#include "gui/document/session/jobs.h"

#include "core/error.h"
#include "gui/base/text.h"
#include "gui/document/jobs/body_drag.h"
#include "gui/document/jobs/job_runner.h"

namespace winslow::gui {

namespace {

/// The quality limits of a command.
const QualityFloor& floor_of(const Command& command) {
  static const QualityFloor none;
  return std::visit(
      [](const auto& c) -> const QualityFloor& {
        if constexpr (requires { c.how.floor; })
          return c.how.floor;
        else
          return none;
      },
      command);
}

}  // namespace

void Jobs::show_position() {
  mesh_.changed();
  selection_.refresh();
  messages_.set_banner_of_position();
}

bool Jobs::poll() {
  bool changed = false;
  if (work_.job().poll()) {
    mesh_.changed();
    changed = true;
  }
  if (work_.drag().poll()) {
    mesh_.changed();
    changed = true;
  }
  if (auto outcome = work_.job().take_outcome()) {
    finish(std::move(*outcome));
    changed = true;
  }
  return changed;
}

bool Jobs::working() const {
  const JobRunner& job = work_.job();
  const auto& snapshot = job.snapshot();
  const bool solving =
      job.active() && !(job.held() && snapshot && snapshot->state == JobState::done);
  const bool paused = job.paused() && snapshot && snapshot->state == JobState::paused;
  const BodyDrag* drag = work_.body_drag();
  return (drag && !drag->settled() && drag->error().empty()) || (solving && !paused);
}

bool Jobs::start(Command command, bool paused, std::optional<Coordinates> start,
                 std::string cut_short) {
  if (!mesh_.document()) return false;
  if (work_.body_drag()) {
    messages_.tell(Notice::Kind::warning,
                   "A body is being dragged. Let it go first, or cancel with Esc.");
    return false;
  }
  if (work_.job().active()) {
    messages_.tell(Notice::Kind::warning, "The solver is at work on \"" +
                                              describe(work_.job().command()) +
                                              "\". Wait until it is done, or cancel it.");
    return false;
  }
  if (const SmoothOptions* smooth = winslow::smooth_options(command)) {
    try {
      validate(*smooth);
    } catch (const Error& error) {
      messages_.report_error("These solver settings cannot be used", error.what());
      return false;
    }
  }
  // A recipe may be for a mesh of another dimension. Check this first: the motion of a running job
  // is queried.
  if (const auto* move = std::get_if<MoveCommand>(&command)) {
    const int dimension = mesh_.document()->state().mesh.topology->space_dimension();
    try {
      for (const MovingBody& body : move->bodies)
        resolve_motion(body.motion, dimension, Vec3(0, 0, 0));
    } catch (const Error& error) {
      messages_.report_error("This motion does not fit the mesh", error.what());
      return false;
    }
  }
  settings_.forget_undone();
  cut_short_ = std::move(cut_short);
  shown_only_ = false;
  messages_.clear_banner();
  work_.set_edited_vcvs({});
  work_.job().set_pace(pace_of(command));
  work_.job().run(mesh_.document()->state(), std::move(command), paused, std::move(start),
                  settings_.resolver());
  mesh_.changed();
  return true;
}

/// The direct method is slowed down for display; all other commands and reruns go at full speed.
double Jobs::pace_of(Command command) const {
  const SmoothOptions* smooth = winslow::smooth_options(command);
  if (!smooth || queue_.active()) return 0;
  const auto* move = std::get_if<MoveCommand>(&command);
  return method_of(*smooth, move ? move->how : settings_.motion_options()) == Method::direct ? pace_
                                                                                             : 0;
}

bool Jobs::can_join(const std::vector<std::string>& markers) const {
  if (!work_.job().active() || rerun_) return false;
  const auto* move = std::get_if<MoveCommand>(&work_.job().command());
  return move && move->bodies.size() == 1 && move->bodies.front().markers == markers;
}

void Jobs::on(const action::RunSmooth&) {
  if (work_.job().paused()) return work_.job().resume();
  start(SmoothCommand{settings_.smooth_in_place()}, false);
}

void Jobs::on(const action::StepSolver& a) {
  if (work_.held().body) return;
  if (!work_.job().active() && !start(SmoothCommand{settings_.smooth_in_place()}, true)) return;
  work_.job().step(a.count);
}

void Jobs::on(const action::SetPace& a) {
  pace_ = std::max(a.iterations_per_second, 0.0);
  if (work_.job().active()) work_.job().set_pace(pace_of(work_.job().command()));
}

void Jobs::on(const action::FollowSolver& a) { work_.job().wait_for_viewer(a.on); }

void Jobs::on(const action::RunCommand& a) {
  const Document* document = mesh_.document();
  const bool clean = document && !document->modified();
  if (start(a.command, a.paused)) shown_only_ = a.shown_only && clean;
}

void Jobs::on(const action::RerunStep& a) {
  Document* document = mesh_.document();
  if (!document || work_.held().body || a.position == 0 || a.position >= document->history().size())
    return;
  if (work_.job().active()) {
    messages_.tell(Notice::Kind::warning,
                   "The solver is at work. Wait until it is done, or cancel it.");
    return;
  }
  document->edits().go_to(a.position - 1);
  show_position();
  start(document->history().command(a.position), true);
  rerun_ = a.position;
}

void Jobs::end_rerun() {
  mesh_.document()->edits().go_to(*rerun_);
  rerun_.reset();
  show_position();
}

void Jobs::cancel() {
  if (!work_.job().active()) return;
  const std::string what = cancelled_text(queue_, work_.job().command());
  stop();
  messages_.tell(Notice::Kind::information, what);
}

void Jobs::stop() {
  work_.held() = {};
  if (work_.body_drag()) {
    work_.drag().end();
    mesh_.changed();
  }
  if (!work_.job().active()) return;
  work_.job().cancel();
  show_position();
  if (rerun_) end_rerun();
  abandon_queue();
}

void Jobs::finish(JobRunner::Outcome outcome) {
  work_.held() = {};
  if (rerun_) return end_rerun();
  if (outcome.result) return keep(std::move(outcome));
  show_position();
  if (queue_.active()) return stop_queue_at(outcome.error);
  if (!outcome.error.empty())
    messages_.report_error("The command failed; the mesh is as it was before", outcome.error);
}

/// Appends the result of a command to the history, and starts the next command. A motion that moves
/// nothing is no step of the history.
void Jobs::keep(JobRunner::Outcome outcome) {
  if (outcome.result->smooth.nothing_moves && !queue_.active()) {
    cut_short_.clear();
    shown_only_ = false;
    show_position();
    messages_.tell(Notice::Kind::information,
                   describe(outcome.command) + ": nothing moves, the mesh stays as it is");
    return;
  }
  messages_.clear_banner();
  const JobRunner& job = work_.job();
  const double reached = settle_command(outcome, job.base().mesh, job.started_elsewhere());
  const SmoothResult smooth = outcome.result->smooth;
  if (reached < 1 || !smooth.limited_by.empty())
    messages_.set_banner(
        Banner::Kind::partial_motion,
        end_of_motion({smooth, reached, floor_of(outcome.command), outcome.result->state.mesh}));
  else if (!cut_short_.empty())
    messages_.set_banner(Banner::Kind::partial_motion, std::exchange(cut_short_, {}));
  const std::string what = describe(outcome.command);
  if (const auto* move = std::get_if<MoveCommand>(&outcome.command)) selection_.moved(*move);
  mesh_.document()->edits().push(std::move(outcome.command), std::move(*outcome.result),
                                 outcome.seconds);
  if (std::exchange(shown_only_, false)) {
    Document& document = *mesh_.document();
    document.saved().mark_shown_only(document.edits().revision());
  }
  mesh_.changed();
  selection_.own().follow_nodes();
  messages_.set_banner_of_result(smooth);
  if (queue_.active()) {
    queue_.advance();
    return run_queue(outcome.paused);
  }
  tell_finished(what, smooth);
}

void Jobs::tell_finished(const std::string& what, const SmoothResult& smooth) {
  if (smooth.outer_iterations == 0) {
    const bool no_need = smooth.converged && smooth.stretched && smooth.fraction_reached == 1;
    messages_.tell(Notice::Kind::success,
                   what + (no_need ? ": the elements have the shapes of their targets" : ""));
  } else if (smooth.inverted > 0 || !smooth.converged) {
    messages_.tell(Notice::Kind::warning,
                   what + ": ended after " + counted(smooth.outer_iterations, "iteration"));
  } else {
    const std::string regions = text_of(smooth.boundary.interfaces);
    messages_.tell(Notice::Kind::success, what + ": converged in " +
                                              counted(smooth.outer_iterations, "iteration") +
                                              (regions.empty() ? "" : ", " + regions));
  }
}

void Jobs::start(CommandQueue::Plan plan) {
  queue_.start(std::move(plan));
  run_queue(false);
}

/// Starts the next command of the queue, or ends the queue. paused: the user steps through it.
void Jobs::run_queue(bool paused) {
  if (!queue_.finished()) {
    if (!start(queue_.next(), paused)) stop_queue_at({});
    return;
  }
  const auto plan = queue_.stop();
  if (plan.end) mesh_.document()->edits().go_to(*plan.end);
  show_position();
  messages_.tell(Notice::Kind::success, finished_text(plan));
}

/// Ends the queue because its next command cannot be carried out. error: why; empty: already
/// reported.
void Jobs::stop_queue_at(const std::string& error) {
  const std::size_t done = queue_.done();
  const auto plan = queue_.stop();
  show_position();
  messages_.ask(stopped_prompt(plan, done, error, mesh_.document()->edits().kept().size()));
}

/// Ends the queue on the user's request.
void Jobs::abandon_queue() {
  if (!queue_.active()) return;
  const auto plan = queue_.stop();
  // A partial rerun would be neither the old nor the new history.
  if (plan.revision) mesh_.document()->edits().take_back();
  show_position();
}

}  // namespace winslow::gui
