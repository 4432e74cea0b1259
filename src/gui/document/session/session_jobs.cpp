#include <string>
#include <utility>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "gui/base/text.h"
#include "gui/document/session/session.h"

namespace winslow::gui {

bool Session::start_job(Command command, bool paused, std::optional<Coordinates> start) {
  if (!document_) return false;
  if (drag_.active()) {
    tell(Notice::Kind::warning, "A body is being dragged. Let it go first, or cancel with Esc.");
    return false;
  }
  if (job_.active()) {
    tell(Notice::Kind::warning, "The solver is at work on \"" + describe(job_.command()) +
                                    "\". Wait until it is done, or cancel it.");
    return false;
  }
  if (const SmoothOptions* smooth = winslow::smooth_options(command)) {
    try {
      validate(*smooth);
    } catch (const Error& error) {
      report_error("These solver settings cannot be used", error.what());
      return false;
    }
  }
  banner_.reset();
  edited_vcv_.reset();
  job_.set_pace(pace_of(command));
  job_.run(document_->state(), std::move(command), paused, std::move(start));
  shape_changed();
  return true;
}

/// The direct method is there to be watched; all else, and what is run again, goes at full speed.
double Session::pace_of(Command command) const {
  const SmoothOptions* smooth = winslow::smooth_options(command);
  if (!smooth || queue_.active()) return 0;
  const auto* move = std::get_if<MoveCommand>(&command);
  return method_of(*smooth, move ? move->how : motion_) == Method::direct ? pace_ : 0;
}

MoveCommand Session::move_command(const RigidMotion& motion) const {
  return MoveCommand{selected_names(), motion, motion_, smooth_};
}

bool Session::can_join(const std::vector<std::string>& markers) const {
  if (!job_.active() || rerun_) return false;
  const auto* move = std::get_if<MoveCommand>(&job_.command());
  return move && move->markers == markers;
}

void Session::on(const action::ApplyMotion& a) {
  if (!document_ || selection_.empty() || dragging_) return;
  if (can_join(selected_names())) {
    job_.retarget(move_command(compose(*live_motion(), a.motion)));
    return;
  }
  start_job(move_command(a.motion), false);
}

void Session::on(const action::RunSmooth&) {
  if (job_.paused()) return on(action::ResumeSolver{});
  start_job(SmoothCommand{smooth_}, false);
}

void Session::on(const action::Scramble& a) { start_job(ScrambleCommand{a.seed}, false); }

void Session::on(const action::RunCommand& a) { start_job(a.command, a.paused); }

void Session::on(const action::RerunStep& a) {
  if (!document_ || dragging_ || a.position == 0 || a.position >= document_->history().size())
    return;
  if (job_.active()) {
    tell(Notice::Kind::warning, "The solver is at work. Wait until it is done, or cancel it.");
    return;
  }
  document_->go_to(a.position - 1);
  position_changed();
  start_job(document_->history().command(a.position), true);
  rerun_ = a.position;
}

void Session::end_rerun() {
  document_->go_to(*rerun_);
  rerun_.reset();
  position_changed();
}

void Session::on(const action::PauseSolver&) { job_.pause(); }

void Session::on(const action::ResumeSolver&) { job_.resume(); }

void Session::on(const action::StepSolver& a) {
  if (dragging_) return;
  if (!job_.active() && !start_job(SmoothCommand{smooth_}, true)) return;
  job_.step(a.count);
}

void Session::on(const action::CancelSolver&) {
  if (!job_.active()) return;
  const std::string what = cancelled_text();
  stop_job();
  tell(Notice::Kind::information, what);
}

void Session::stop_job() {
  dragging_ = editing_vcv_ = false;
  drag_base_.reset();
  if (drag_.active()) {
    drag_.end();
    shape_changed();
  }
  if (!job_.active()) return;
  job_.cancel();
  position_changed();
  if (rerun_) end_rerun();
  abandon_queue();
}

void Session::finish_job(JobRunner::Outcome outcome) {
  dragging_ = editing_vcv_ = false;
  if (rerun_) return end_rerun();
  if (!outcome.result) {
    position_changed();
    if (queue_.active()) return stop_queue_at(outcome.error);
    if (!outcome.error.empty())
      report_error("The command failed; the mesh is as it was before", outcome.error);
    return;
  }
  banner_.reset();
  settle_motion(outcome);
  const std::string what = describe(outcome.command);
  const SmoothResult smooth = outcome.result->smooth;
  if (const auto* move = std::get_if<MoveCommand>(&outcome.command))
    pivot_ = transform(move->motion, pivot_);
  document_->push(std::move(outcome.command), std::move(*outcome.result), outcome.seconds);
  shape_changed();
  update_anchors();
  update_banner(smooth);
  if (queue_.active()) {
    queue_.advance();
    return run_queue(outcome.paused);
  }
  tell_finished(what, smooth);
}

void Session::update_banner(const SmoothResult& smooth) {
  if (banner_ && banner_->kind == Banner::Kind::partial_motion && smooth.inverted == 0) return;
  if (smooth.inverted > 0) {
    banner_ = Banner{Banner::Kind::inverted_result,
                     "The result has " + counted(smooth.inverted, "inverted element") +
                         ". A flow solver cannot use this mesh."};
  } else if (!smooth.converged) {
    banner_ = Banner{Banner::Kind::not_converged,
                     "Stopped after " + counted(smooth.outer_iterations, "iteration") +
                         " at a residual of " + short_number(smooth.residual) +
                         ": valid, but not converged."};
  }
}

void Session::tell_finished(const std::string& what, const SmoothResult& smooth) {
  if (smooth.outer_iterations == 0) {
    tell(Notice::Kind::success, what);
  } else if (smooth.inverted > 0 || !smooth.converged) {
    tell(Notice::Kind::warning,
         what + ": ended after " + counted(smooth.outer_iterations, "iteration"));
  } else {
    tell(Notice::Kind::success,
         what + ": converged in " + counted(smooth.outer_iterations, "iteration"));
  }
}

}  // namespace winslow::gui
