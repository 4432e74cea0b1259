#include "gui/document/session/jobs.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/geometry/periodic_pairs.h"
#include "core/strategy/smooth_options.h"
#include "gui/base/text.h"
#include "gui/document/jobs/body_drag.h"
#include "gui/document/jobs/job_runner.h"
#include "gui/document/jobs/run_settings.h"
#include "io/tables/reference_file.h"

namespace winslow::gui {

namespace {

/// The limits of the quality that a command has.
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

bool Jobs::poll() {
  const Document* document = mesh_.document();
  smooth_.slide.file_pairs.found =
      document && document->details() ? document->details()->periodic : nullptr;
  bool changed =
      layer_preview_.update(document && !mesh_.in_motion() ? &document->state().mesh : nullptr);
  changed |= found_layers_.update(document && !mesh_.in_motion() ? &document->state() : nullptr);
  changed |= poll_reference();
  if (mesh_.job().poll()) {
    mesh_.changed();
    changed = true;
  }
  if (mesh_.drag().poll()) {
    mesh_.changed();
    changed = true;
  }
  if (auto outcome = mesh_.job().take_outcome()) {
    finish(std::move(*outcome));
    changed = true;
  }
  return changed;
}

bool Jobs::working() const {
  const JobRunner& job = mesh_.job();
  const auto& snapshot = job.snapshot();
  const bool solving =
      job.active() && !(job.held() && snapshot && snapshot->state == JobState::done);
  const bool paused = job.paused() && snapshot && snapshot->state == JobState::paused;
  const BodyDrag* drag = mesh_.body_drag();
  return (drag && !drag->settled() && drag->error().empty()) || reference_.busy() ||
         layer_preview_.busy() || found_layers_.busy() || (solving && !paused);
}

bool Jobs::start(Command command, bool paused, std::optional<Coordinates> start,
                 std::string cut_short) {
  if (!mesh_.document()) return false;
  if (mesh_.body_drag()) {
    messages_.tell(Notice::Kind::warning,
                   "A body is being dragged. Let it go first, or cancel with Esc.");
    return false;
  }
  if (mesh_.job().active()) {
    messages_.tell(Notice::Kind::warning, "The solver is at work on \"" +
                                              describe(mesh_.job().command()) +
                                              "\". Wait until it is done, or cancel it.");
    return false;
  }
  io::give_pairs(command, mesh_.document()->details().get());
  if (const SmoothOptions* smooth = winslow::smooth_options(command)) {
    try {
      validate(*smooth);
    } catch (const Error& error) {
      messages_.report_error("These solver settings cannot be used", error.what());
      return false;
    }
  }
  // Of a recipe for a mesh of another kind; while it is under way its motion is asked for.
  if (const auto* move = std::get_if<MoveCommand>(&command)) {
    try {
      require_fits(move->motion, mesh_.document()->state().mesh.topology->space_dimension());
    } catch (const Error& error) {
      messages_.report_error("This motion does not fit the mesh", error.what());
      return false;
    }
  }
  overrides_.forget_undone();
  cut_short_ = std::move(cut_short);
  shown_only_ = false;
  messages_.clear_banner();
  mesh_.instead().vcv = nullptr;
  mesh_.instead().sphere_vcvs.reset();
  mesh_.job().set_pace(pace_of(command));
  mesh_.job().run(mesh_.document()->state(), std::move(command), paused, std::move(start));
  mesh_.changed();
  return true;
}

/// The direct method is there to be watched; all else, and what is run again, goes at full speed.
double Jobs::pace_of(Command command) const {
  const SmoothOptions* smooth = winslow::smooth_options(command);
  if (!smooth || queue_.active()) return 0;
  const auto* move = std::get_if<MoveCommand>(&command);
  return method_of(*smooth, move ? move->how : motion_) == Method::direct ? pace_ : 0;
}

SmoothOptions Jobs::smooth_for_motion(const std::vector<std::string>& markers) const {
  SmoothOptions smooth = smooth_;
  if (const Document* document = mesh_.document())
    leave_to_motion(smooth.slide, *document->state().mesh.topology, markers);
  return smooth;
}

void Jobs::on(const action::OverrideNode& a) {
  const Document* document = mesh_.document();
  if (document && a.node >= 0 && a.node < document->state().mesh.topology->node_count())
    overrides_.set(smooth_.slide, a.node, a.to, document->edits().revision());
}

void Jobs::on(const action::StepOverride& a) {
  const std::string what =
      a.again ? overrides_.redo(smooth_.slide) : overrides_.undo(smooth_.slide);
  messages_.tell(Notice::Kind::information, (a.again ? "Done again: " : "Undone: ") + what);
}

void Jobs::forget_mesh() {
  smooth_.keep_outside = {};
  smooth_.slide = {};
  overrides_.clear();
  reference_.drop();
  const Document* document = mesh_.document();
  if (document && is_surface(*document->state().mesh.topology)) settle_for_surface(smooth_);
}

MoveCommand Jobs::move_command(const RigidMotionRequest& motion) const {
  const std::vector<std::string> markers = selection_.names();
  return MoveCommand{markers, motion, motion_, smooth_for_motion(markers)};
}

bool Jobs::can_join(const std::vector<std::string>& markers) const {
  if (!mesh_.job().active() || rerun_) return false;
  const auto* move = std::get_if<MoveCommand>(&mesh_.job().command());
  return move && move->markers == markers;
}

void Jobs::show_position() {
  mesh_.changed();
  selection_.refresh();
  messages_.set_banner_of_position();
}

void Jobs::on(const action::RunSmooth&) {
  if (mesh_.job().paused()) return mesh_.job().resume();
  start(SmoothCommand{smooth_in_place()}, false);
}

void Jobs::on(const action::StepSolver& a) {
  if (mesh_.held().body) return;
  if (!mesh_.job().active() && !start(SmoothCommand{smooth_in_place()}, true)) return;
  mesh_.job().step(a.count);
}

void Jobs::on(const action::PairMarkers& a) {
  if (!mesh_.document()) return;
  try {
    const Mesh& mesh = mesh_.document()->state().mesh;
    SlideOptions slide = smooth_.slide;
    const std::string done = pair_sides(slide, mesh, a.first, a.second);
    smooth_.slide = std::move(slide);
    messages_.tell(Notice::Kind::information, done);
  } catch (const UsageError& error) {
    messages_.report_error("These markers are not periodic", error.what());
  }
}

void Jobs::on(const action::ChooseReference& a) {
  reference_.drop();
  if (a.file.empty()) {
    smooth_.slide.reference = {};
    return;
  }
  if (mesh_.document() && in_space(mesh_))
    reference_.choose(a.file, shared_mesh(mesh_), smooth_.slide.markers, reference_files(mesh_));
}

bool Jobs::poll_reference() {
  const auto read = reference_.poll();
  if (!read || !mesh_.document()) return false;
  if (!read->error.empty()) {
    messages_.report_error(
        read->file.filename().string() + " cannot be used as a reference surface", read->error);
    return true;
  }
  smooth_.slide.reference = {read->file.string(), nullptr};
  messages_.tell(is_coarse(*read) ? Notice::Kind::warning : Notice::Kind::success, describe(*read));
  return true;
}

void Jobs::on(const action::SetPace& a) {
  pace_ = std::max(a.iterations_per_second, 0.0);
  if (mesh_.job().active()) mesh_.job().set_pace(pace_of(mesh_.job().command()));
}

void Jobs::on(const action::FollowSolver& a) { mesh_.job().follow(a.on); }

void Jobs::on(const action::RunCommand& a) {
  const Document* document = mesh_.document();
  const bool clean = document && !document->modified();
  if (start(a.command, a.paused)) shown_only_ = a.shown_only && clean;
}

void Jobs::on(const action::RerunStep& a) {
  Document* document = mesh_.document();
  if (!document || mesh_.held().body || a.position == 0 || a.position >= document->history().size())
    return;
  if (mesh_.job().active()) {
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
  if (!mesh_.job().active()) return;
  const std::string what = cancelled_text();
  stop();
  messages_.tell(Notice::Kind::information, what);
}

void Jobs::stop() {
  mesh_.held() = {};
  if (mesh_.body_drag()) {
    mesh_.drag().end();
    mesh_.changed();
  }
  if (!mesh_.job().active()) return;
  mesh_.job().cancel();
  show_position();
  if (rerun_) end_rerun();
  abandon_queue();
}

void Jobs::finish(JobRunner::Outcome outcome) {
  mesh_.held() = {};
  if (rerun_) return end_rerun();
  if (outcome.result) return keep(std::move(outcome));
  show_position();
  if (queue_.active()) return stop_queue_at(outcome.error);
  if (!outcome.error.empty())
    messages_.report_error("The command failed; the mesh is as it was before", outcome.error);
}

/// Puts what a command has come to into the history, and goes on with the next one.
void Jobs::keep(JobRunner::Outcome outcome) {
  messages_.clear_banner();
  const JobRunner& job = mesh_.job();
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
  if (std::exchange(shown_only_, false)) mesh_.document()->mark_shown_only();
  mesh_.changed();
  selection_.update_anchors();
  messages_.set_banner_of_result(smooth);
  if (queue_.active()) {
    queue_.advance();
    return run_queue(outcome.paused);
  }
  tell_finished(what, smooth);
}

void Jobs::tell_finished(const std::string& what, const SmoothResult& smooth) {
  if (smooth.outer_iterations == 0) {
    messages_.tell(Notice::Kind::success, what);
  } else if (smooth.inverted > 0 || !smooth.converged) {
    messages_.tell(Notice::Kind::warning,
                   what + ": ended after " + counted(smooth.outer_iterations, "iteration"));
  } else {
    messages_.tell(Notice::Kind::success,
                   what + ": converged in " + counted(smooth.outer_iterations, "iteration"));
  }
}

void Jobs::start(CommandQueue::Plan plan) {
  queue_.start(std::move(plan));
  run_queue(false);
}

/// Starts the next command of the queue, or ends it. paused: the user goes step by step.
void Jobs::run_queue(bool paused) {
  if (!queue_.finished()) {
    if (!start(queue_.next(), paused)) stop_queue_at({});
    return;
  }
  const auto plan = queue_.stop();
  if (plan.end) mesh_.document()->edits().go_to(*plan.end);
  show_position();
  messages_.tell(
      Notice::Kind::success,
      plan.commands.empty()
          ? "The step is deleted"
          : plan.title + ": " + counted(plan.commands.size(), "command") + " carried out");
}

/// The next command of the queue cannot be carried out. error: why, if that was not said yet.
void Jobs::stop_queue_at(const std::string& error) {
  const std::size_t done = queue_.done();
  const auto plan = queue_.stop();
  show_position();
  std::string text = "Step " + std::to_string(plan.start + done + 1) + " (" +
                     describe(plan.commands[done]) + ") failed";
  text += error.empty() ? "." : ": " + error;
  text += done == 0
              ? "\nNothing before it was run."
              : "\nThe history ends before it, after " + counted(done, "command") + " carried out.";
  Prompt prompt{Prompt::Kind::error, plan.title + " stopped", {}, {}};
  if (plan.revision) {
    text += "\nThe history from before the change is kept.";
    prompt.choices.push_back(
        {"Bring it back", {action::BringBack{mesh_.document()->edits().kept().size() - 1}}, true});
    prompt.choices.push_back({"Leave it so", {}, false});
  } else {
    prompt.choices.push_back({"OK", {}, true});
  }
  prompt.text = std::move(text);
  messages_.ask(std::move(prompt));
}

/// Ends the queue on the user's behalf.
void Jobs::abandon_queue() {
  if (!queue_.active()) return;
  const auto plan = queue_.stop();
  // What was begun would be neither the old history nor the new one.
  if (plan.revision) mesh_.document()->edits().take_back();
  show_position();
}

std::string Jobs::cancelled_text() const {
  if (!queue_.active())
    return "Cancelled: " + describe(mesh_.job().command()) + ". The mesh is as it was before.";
  if (queue_.plan().revision) return "Cancelled. The history is as it was before the change.";
  return "Cancelled after " + counted(queue_.done(), "command") + " of " +
         std::to_string(queue_.total()) + "; those stay in the history.";
}

}  // namespace winslow::gui
