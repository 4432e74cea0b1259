#include "gui/document/jobs/job_runner.h"

#include <utility>

#include "core/motion/rigid_motion.h"

namespace winslow::gui {

JobRunner::JobRunner(std::shared_ptr<ReferenceFiles> references) {
  solver_.prepare([files = std::move(references)](Command& command) { files->load(command); });
}

bool JobRunner::paused() const { return active_ && pause_requested_; }

void JobRunner::run(MeshState base, Command command, bool paused,
                    std::optional<Coordinates> start) {
  base_ = std::make_shared<const MeshState>(std::move(base));
  const MeshState* const mesh = base_.get();
  command_ = with_pivot(std::move(command), std::span(&mesh, 1));
  snapshot_.reset();
  active_ = true;
  held_ = false;
  pause_requested_ = paused;
  started_ = std::chrono::steady_clock::now();
  start_ = start;
  job_ = solver_.run(base_, command_, std::move(start), paused);
}

const Coordinates& JobRunner::coordinates() const {
  if (snapshot_ && snapshot_->mesh) return snapshot_->mesh->coordinates;
  return start_ ? *start_ : base_->mesh.coordinates;
}

const std::shared_ptr<const Topology>& JobRunner::topology() const {
  if (snapshot_ && snapshot_->mesh) return snapshot_->mesh->topology;
  return base_->mesh.topology;
}

void JobRunner::retarget(Command command) {
  command_ = std::move(command);
  pause_requested_ = false;
  solver_.retarget(command_);
  solver_.resume();
  // A job that had ended starts again under a new number.
  job_ = solver_.latest()->job;
}

bool JobRunner::converged() const {
  if (!snapshot_ || snapshot_->state != JobState::done || !meets_target(*snapshot_)) return false;
  const auto& result = snapshot_->result;
  return result && result->smooth.converged && result->smooth.inverted == 0;
}

void JobRunner::pause() {
  if (!active_) return;
  pause_requested_ = true;
  solver_.pause();
}

void JobRunner::resume() {
  if (!active_) return;
  pause_requested_ = false;
  solver_.resume();
}

void JobRunner::step(int count) {
  if (!active_) return;
  pause_requested_ = true;
  solver_.step(count);
}

void JobRunner::set_pace(double iterations_per_second) {
  if (iterations_per_second == pace_) return;
  pace_ = iterations_per_second;
  solver_.set_pace(pace_);
}

void JobRunner::follow(bool on) {
  if (on)
    solver_.follow(snapshot_ ? snapshot_->serial : 0);
  else
    solver_.follow({});
}

void JobRunner::cancel() {
  if (!active_) return;
  solver_.cancel();
  active_ = held_ = pause_requested_ = false;
  snapshot_.reset();
}

bool JobRunner::poll() {
  if (!active_) return false;
  auto latest = solver_.latest();
  if (latest->job != job_) return false;
  if (snapshot_ && snapshot_->serial == latest->serial) return false;
  snapshot_ = std::move(latest);
  return true;
}

bool JobRunner::meets_target(const Snapshot& snapshot) const {
  if (const auto* edit = std::get_if<EditVcvCommand>(&command_)) {
    const auto* done = snapshot.command ? std::get_if<EditVcvCommand>(&*snapshot.command) : nullptr;
    return done && done->edits == edit->edits;
  }
  const auto* target = std::get_if<MoveCommand>(&command_);
  if (!target) return true;
  if (!snapshot.command) return false;
  const auto* reached = std::get_if<MoveCommand>(&*snapshot.command);
  return reached && reached->motion == target->motion;
}

std::optional<JobRunner::Outcome> JobRunner::take_outcome() {
  if (!active_ || held_ || !snapshot_) return std::nullopt;
  const JobState state = snapshot_->state;
  if (state != JobState::done && state != JobState::failed && state != JobState::cancelled)
    return std::nullopt;
  // A drag may have moved on since this snapshot was published.
  if (!meets_target(*snapshot_)) return std::nullopt;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - started_;
  Outcome outcome{command_, snapshot_->result, snapshot_->error, taken.count(), pause_requested_};
  active_ = pause_requested_ = false;
  snapshot_.reset();
  return outcome;
}

}  // namespace winslow::gui
