#include "gui/document/session/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/motion/rigid_motion.h"
#include "gui/base/text.h"

namespace winslow::gui {

Session::Session() = default;

void Session::apply(const DocumentAction& action) {
  std::visit([this](const auto& group) { Dispatch::to(*this, group); }, action);
}

bool Session::poll() {
  bool changed = poll_loader();
  changed |= poll_saver();
  changed |= poll_recipe();
  changed |= poll_csv();
  changed |= quality_.poll();
  changed |= layer_preview_.update(document_ && !in_motion() ? &document_->state().mesh : nullptr);
  if (job_.poll()) {
    shape_changed();
    changed = true;
  }
  if (drag_.poll()) {
    shape_changed();
    changed = true;
  }
  if (auto outcome = job_.take_outcome()) {
    finish_job(std::move(*outcome));
    changed = true;
  }
  return changed;
}

bool Session::working() const {
  const bool solving = job_.active() && !(job_.held() && job_.snapshot() &&
                                          job_.snapshot()->state == JobState::done);
  const bool paused =
      job_.paused() && job_.snapshot() && job_.snapshot()->state == JobState::paused;
  const bool following = drag_.active() && !drag_.settled();
  return following || loader_.busy() || saver_.busy() || recipe_reader_.busy() ||
         csv_writer_.busy() || quality_.busy() || layer_preview_.busy() || (solving && !paused);
}

const Coordinates& Session::coordinates() const {
  static const Coordinates none;
  if (!document_) return none;
  if (drag_.active()) return drag_.frame().coordinates;
  return job_.active() ? job_.coordinates() : document_->state().mesh.coordinates;
}

const MeshState& Session::motion_base() const {
  if (drag_.active()) return drag_state_;
  return job_.active() ? job_.base() : document_->state();
}

std::optional<RigidMotion> Session::live_motion() const {
  if (drag_.active()) return drag_.grip().rigid() ? std::optional(drag_.wanted()) : std::nullopt;
  if (!job_.active()) return std::nullopt;
  const auto* move = std::get_if<MoveCommand>(&job_.command());
  if (!move) return std::nullopt;
  return move->motion;
}

std::span<const IterationRecord> Session::convergence() const {
  if (job_.active()) {
    if (!job_.snapshot()) return {};
    return job_.snapshot()->history;
  }
  if (!document_ || document_->history().position() == 0) return {};
  return document_->history().result(document_->history().position()).history;
}

bool Session::selected(Index marker) const {
  return std::binary_search(selection_.begin(), selection_.end(), marker);
}

Vec2 Session::pivot() const {
  const auto motion = live_motion();
  return motion ? transform(*motion, pivot_) : pivot_;
}

void Session::watch_quality(std::optional<ElementField> field) {
  if (!document_) return;
  if (quality_.wants(shape_, field, in_motion()))
    quality_.request(shape_, measured_state(), field, in_motion());
}

void Session::measure_quality_now(std::optional<ElementField> field) {
  if (!document_) return;
  quality_.measure_now(shape_, measured_state(), field);
}

MeshState Session::measured_state() const { return {{topology(), coordinates()}, vcv(), layers()}; }

void Session::tell(Notice::Kind kind, std::string text) {
  notice_ = Notice{kind, std::move(text), std::chrono::steady_clock::now()};
}

void Session::report_error(std::string title, std::string text) {
  ask({Prompt::Kind::error, std::move(title), std::move(text), {{"OK", {}, true}}});
}

void Session::on(const action::EditMotionOptions& a) { a.edit.apply_to(motion_); }

void Session::on(const action::EditSmoothOptions& a) { a.edit.apply_to(smooth_); }

void Session::on(const action::SetPace& a) {
  pace_ = std::max(a.iterations_per_second, 0.0);
  if (job_.active()) job_.set_pace(pace_of(job_.command()));
}

void Session::on(const action::Undo&) {
  if (!document_) return;
  if (dragging_) return on(action::CancelDrag{});
  if (job_.active()) return on(action::CancelSolver{});
  const History& history = document_->history();
  if (!history.can_undo()) return;
  const std::string undone = describe(history.command(history.position()));
  document_->undo();
  position_changed();
  tell(Notice::Kind::information, "Undone: " + undone);
}

void Session::on(const action::Redo&) {
  if (!document_ || job_.active() || dragging_ || !document_->history().can_redo()) return;
  document_->redo();
  position_changed();
  const History& history = document_->history();
  tell(Notice::Kind::information, "Done again: " + describe(history.command(history.position())));
}

void Session::on(const action::GoToStep& a) {
  if (!document_) return;
  stop_job();
  document_->go_to(a.position);
  position_changed();
  const History& history = document_->history();
  tell(Notice::Kind::information,
       history.position() == 0
           ? "The mesh is as it was opened."
           : "The mesh is as it was after: " + describe(history.command(history.position())));
}

void Session::on(const action::DismissPrompt&) {
  if (!prompts_.empty()) prompts_.pop_front();
}

void Session::on(const action::DismissBanner&) {
  if (banner_ && document_) dismissed_ = std::pair(generation_, document_->revision());
  banner_.reset();
}

void Session::shape_changed() {
  ++shape_;
  follow_topology();
  if (boundary_) boundary_->update(coordinates());
}

void Session::position_changed() {
  shape_changed();
  preview_.reset();
  update_anchors();
  place_pivot();
  banner_of_position();
}

/// What the mesh at this position of the history calls for, if anything.
void Session::banner_of_position() {
  const History& history = document_->history();
  banner_.reset();
  if (history.position() > 0) return update_banner(history.result(history.position()));
  if (const Index inverted = document_->loaded_quality().inverted; inverted > 0)
    banner_ = Banner{Banner::Kind::inverted_input, "This mesh has " +
                                                       counted(inverted, "inverted element") +
                                                       ". Smoothing usually repairs it."};
}

std::vector<std::string> Session::selected_names() const {
  std::vector<std::string> names;
  for (Index m : selection_)
    names.push_back(topology()->markers()[static_cast<std::size_t>(m)].name);
  return names;
}

}  // namespace winslow::gui
