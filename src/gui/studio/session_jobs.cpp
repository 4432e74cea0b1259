#include <string>
#include <utility>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "gui/studio/session.h"
#include "gui/studio/text.h"

namespace winslow::gui {

bool Session::start_job(Command command, bool paused) {
  if (!document_) return false;
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
  job_.run(document_->state(), std::move(command), paused);
  shape_changed();
  return true;
}

MoveCommand Session::move_command(const RigidMotion& motion) const {
  return MoveCommand{selected_names(), motion, motion_, smooth_};
}

bool Session::can_join(const std::vector<std::string>& markers) const {
  if (!job_.active()) return false;
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

void Session::on(const action::BeginDrag&) {
  if (!document_ || selection_.empty() || dragging_) return;
  drag_base_.reset();
  if (job_.active()) {
    if (!can_join(selected_names())) {
      tell(Notice::Kind::warning,
           "The solver is at work on another body. Wait until it is done, or cancel it.");
      return;
    }
    drag_base_ = live_motion();
    job_.hold(true);
  }
  dragging_ = true;
}

void Session::on(const action::DragTo& a) {
  if (!dragging_) return;
  MoveCommand command = move_command(drag_base_ ? compose(*drag_base_, a.motion) : a.motion);
  // Under the mouse the mesh follows its path, through valid meshes only. Steps that the user chose
  // are for the place where the body is let go; until then it goes there at once.
  command.how.increments = motion_.increments == 0 ? 0 : 1;
  if (job_.active()) {
    job_.retarget(command);
    return;
  }
  if (!start_job(command, false)) {
    dragging_ = false;
    return;
  }
  job_.hold(true);
}

void Session::on(const action::EndDrag&) {
  if (!dragging_) return;
  dragging_ = false;
  drag_base_.reset();
  job_.hold(false);
  const auto motion = live_motion();
  if (!motion) return;
  const MoveCommand wanted = move_command(*motion);
  // What has converged under the mouse needs no second run, unless other steps were asked for.
  if (wanted.how.increments <= 1 && job_.converged())
    job_.rename(wanted);
  else
    job_.retarget(wanted);
}

void Session::on(const action::CancelDrag&) {
  if (!dragging_) return;
  dragging_ = false;
  job_.hold(false);
  if (drag_base_) {
    job_.retarget(move_command(*drag_base_));
    drag_base_.reset();
  } else {
    stop_job();
  }
  tell(Notice::Kind::information, "Drag cancelled");
}

void Session::on(const action::RunSmooth&) {
  if (job_.paused()) return on(action::ResumeSolver{});
  start_job(SmoothCommand{smooth_}, false);
}

void Session::on(const action::Scramble& a) { start_job(ScrambleCommand{a.seed}, false); }

void Session::on(const action::PauseSolver&) { job_.pause(); }

void Session::on(const action::ResumeSolver&) { job_.resume(); }

void Session::on(const action::StepSolver& a) {
  if (dragging_) return;
  if (!job_.active() && !start_job(SmoothCommand{smooth_}, true)) return;
  job_.step(a.count);
}

void Session::on(const action::CancelSolver&) {
  if (!job_.active()) return;
  const std::string what = describe(job_.command());
  stop_job();
  tell(Notice::Kind::information, "Cancelled: " + what + ". The mesh is as it was before.");
}

void Session::stop_job() {
  dragging_ = false;
  drag_base_.reset();
  if (!job_.active()) return;
  job_.cancel();
  shape_changed();
}

void Session::finish_job(JobRunner::Outcome outcome) {
  dragging_ = false;
  if (!outcome.result) {
    shape_changed();
    if (!outcome.error.empty())
      report_error("The command failed; the mesh is as it was before", outcome.error);
    return;
  }
  const std::string what = describe(outcome.command);
  const SmoothResult smooth = outcome.result->smooth;
  if (const auto* move = std::get_if<MoveCommand>(&outcome.command))
    pivot_ = transform(move->motion, pivot_);
  document_->push(std::move(outcome.command), std::move(*outcome.result));
  shape_changed();
  update_banner(smooth);
  tell_finished(what, smooth);
}

void Session::update_banner(const SmoothResult& smooth) {
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
