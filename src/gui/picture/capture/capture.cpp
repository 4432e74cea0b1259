#include "gui/picture/capture/capture.h"

#include <cstdio>

#include "core/command/motion_frames.h"
#include "core/error.h"
#include "core/motion/transfer.h"
#include "gui/files/assets.h"
#include "gui/picture/figure/vector_figure.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

// Dialogs and menus disappear only after a frame or two.
constexpr int frames_until_clear = 3;

std::string full_name(const fs::path& path) {
  std::error_code ignored;
  return fs::absolute(path, ignored).string();
}

}  // namespace

fs::path Capture::new_picture_name() {
  for (int n = 1;; ++n) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "winslow-%03d.png", n);
    std::error_code ignored;
    if (!fs::exists(name.data(), ignored)) return name.data();
  }
}

void Capture::on(const action::TakeScreenshot& a) {
  const fs::path path = a.path.empty() ? new_picture_name() : a.path;
  if (!session_.messages().may_write(path)) return;
  if (session_.messages().may_replace(path, a.overwrite, {}, action::TakeScreenshot{path, true}))
    due_ = Due{path, false, frames_until_clear};
}

void Capture::on(const action::SavePicture& a) {
  if (a.path.empty() || !session_.messages().may_write(a.path)) return;
  if (session_.messages().may_replace(a.path, a.overwrite, {}, action::SavePicture{a.path, true}))
    due_ = Due{a.path, true, frames_until_clear};
}

void Capture::on(const action::StartRecording& a) {
  if (a.path.empty()) return;
  if (recorder_.state() != Recorder::State::idle) {
    session_.messages().tell(Notice::Kind::warning, "A recording is under way already.");
    return;
  }
  if (!session_.document()) {
    session_.messages().tell(Notice::Kind::warning, "There is no mesh to record.");
    return;
  }
  if (recording_.when == RecordingSpec::When::turntable && !a.step && !session_.in_space()) {
    session_.messages().tell(Notice::Kind::warning,
                             "A turn around the mesh is for meshes in space: choose another way to "
                             "take frames.");
    return;
  }
  if (!session_.messages().may_write(a.path)) return;
  if (!a.overwrite && Recorder::occupied(a.path)) {
    session_.messages().ask(
        {Prompt::Kind::question,
         "Replace the recording?",
         a.path.filename().string() + " exists already. Its frames are replaced.",
         {{"Replace", {action::StartRecording{a.path, a.step, true}}, false},
          {"Cancel", {}, true}}});
    return;
  }
  try {
    recorder_.start(a.path, recording_);
  } catch (const Error& error) {
    session_.messages().report_error("Cannot record", error.what());
    return;
  }
  meshes_.clear();
  shape_ = left_ = 0;
  turns_ = 0;
  queue_.clear();
  ending_ = false;
  stepping_ = a.step.has_value();
  follow_solver();  // since a motion may begin before the next frame is drawn
  if (!stepping_) return;
  session_.apply(action::RerunStep{*a.step});
  if (!session_.job().active()) recorder_.cancel();
}

/// Records what has happened so far, which may need some more frames.
void Capture::on(const action::StopRecording&) {
  stepping_ = false;
  ending_ = recorder_.state() == Recorder::State::recording;
}

void Capture::on(const action::CancelRecording&) {
  if (recorder_.state() == Recorder::State::idle) return;
  stepping_ = ending_ = false;
  queue_.clear();
  recorder_.cancel();
  session_.messages().tell(Notice::Kind::information, "The recording was thrown away.");
}

void Capture::after_frame(PictureSource& source) {
  if (due_ && --due_->delay <= 0) {
    const Due due = *std::exchange(due_, std::nullopt);
    save_picture(source, due.path, due.as_set);
  }
  if (recorder_.state() == Recorder::State::recording) record_frame(source);
  follow_solver();
}

/// While every shape is recorded, the solver waits for its pictures: with a slow window meshes
/// would be missing, and interpolated meshes between distant ones can be invalid.
void Capture::follow_solver() {
  const bool follow = recorder_.state() == Recorder::State::recording && !stepping_ && !ending_ &&
                      recorder_.spec().when == RecordingSpec::When::every_shape;
  if (follow || following_) session_.apply(action::FollowSolver{follow});
  following_ = follow;
}

void Capture::save_picture(PictureSource& source, const fs::path& path, bool as_set) {
  try {
    if (as_set && is_vector_format(path)) {
      if (figure_.busy()) throw Error("Another figure is being written. Wait until it is done.");
      figure_path_ = path;
      figure_.start([path, figure = source.figure(picture_.legend)] {
        return error_of([&] { write_figure(path, figure); });
      });
      return;
    }
    Image image = as_set ? source.picture(picture_) : source.picture();
    if (!writer_.has_room()) throw Error("Too many pictures are being written. Wait a moment.");
    writer_.push(path, std::move(image));
  } catch (const Error& error) {
    session_.messages().report_error("Cannot save the picture", error.what());
  }
}

bool Capture::frame_due() const {
  if (recorder_.spec().when == RecordingSpec::When::every_shape || stepping_)
    return shape_ != session_.shape() && !meshes_.has(session_.coordinates());
  const auto since = std::chrono::steady_clock::now() - last_frame_;
  return since >= std::chrono::duration<double>(1.0 / recorder_.spec().rate);
}

/// Queues the mesh on screen and, for a motion in large steps, the meshes on the way to it.
void Capture::queue_frames() {
  const bool every_shape = recorder_.spec().when == RecordingSpec::When::every_shape || stepping_;
  // A film that lags far behind would never finish.
  constexpr std::size_t longest_queue = 400;
  for (Coordinates& x : meshes_.collect(session_, every_shape && queue_.size() < longest_queue))
    queue_.push_back({session_.topology(), std::move(x), 0});
  last_frame_ = std::chrono::steady_clock::now();
}

bool Capture::turning() const {
  return recorder_.state() == Recorder::State::recording &&
         recorder_.spec().when == RecordingSpec::When::turntable && !stepping_;
}

/// Queues the next frame of a turn; the recording ends with the last one.
void Capture::queue_turn() {
  const int frames = turntable_frames(recorder_.spec());
  if (turns_ >= frames) {
    ending_ = true;
    return;
  }
  if (!queue_.empty()) return;
  queue_.push_back({session_.topology(), session_.coordinates(), 360.0 * turns_ / frames});
  ++turns_;
}

/// Records one picture; the rest waits for the next frame of the window. False if that failed.
bool Capture::record_queued(PictureSource& source) {
  const Frame next = std::move(queue_.front());
  queue_.pop_front();
  if (next.topology != session_.topology()) return true;
  bool drawn = true;
  try {
    PictureSpec spec = recorder_.spec().picture;
    if (!spec.size) {
      // The window may change its size during the recording; a film must not.
      const ScreenVector extent = source.picture_extent(spec);
      recorder_.fix_size(picture_size(spec, extent.x(), extent.y()));
      spec = recorder_.spec().picture;
    }
    spec.turned = next.turned;
    recorder_.add(source.picture_of(next.coordinates, spec));
  } catch (const Error& error) {
    drawn = false;
    recorder_.cancel();
    queue_.clear();
    stepping_ = ending_ = false;
    session_.messages().report_error("Cannot record", error.what());
  }
  return drawn;
}

void Capture::record_frame(PictureSource& source) {
  if (!session_.document()) queue_.clear();
  if (!session_.document()) return recorder_.stop();
  if (turning() && !ending_) queue_turn();
  const bool timed = recorder_.spec().when == RecordingSpec::When::timed && !stepping_;
  if (!ending_ && !turning() && frame_due()) {
    if (timed && !recorder_.has_room()) {
      recorder_.drop();  // what moves by itself does not wait for the disk
      last_frame_ = std::chrono::steady_clock::now();
    } else {
      queue_frames();
    }
  }
  if (!queue_.empty() && recorder_.has_room() && !record_queued(source)) return;
  shape_ = session_.shape();
  if (!queue_.empty()) return;
  if (ending_) {
    ending_ = false;
    return recorder_.stop();
  }
  if (stepping_) step_on();
}

void Capture::step_on() {
  const JobRunner& job = session_.job();
  if (!job.active()) return on(action::StopRecording{});
  const auto& snapshot = job.snapshot();
  // A requested step takes a while to be seen: leave each pause only once.
  if (!snapshot || snapshot->state != JobState::paused || snapshot->serial == left_) return;
  left_ = snapshot->serial;
  session_.apply(action::StepSolver{1});
}

bool Capture::poll() {
  bool news = false;
  for (const auto& outcome : writer_.take_outcomes()) {
    news = true;
    if (outcome.error.empty())
      session_.messages().tell(Notice::Kind::success,
                               "Picture saved to " + full_name(outcome.path));
    else
      session_.messages().report_error("Cannot save the picture", outcome.error);
  }
  if (const auto error = figure_.poll()) {
    news = true;
    if (error->empty())
      session_.messages().tell(Notice::Kind::success, "Figure saved to " + full_name(figure_path_));
    else
      session_.messages().report_error("Cannot save the figure", *error);
  }
  if (const auto outcome = recorder_.poll()) {
    news = true;
    stepping_ = false;
    using Kind = Recorder::Outcome::Kind;
    if (outcome->kind == Kind::done)
      session_.messages().tell(Notice::Kind::success, outcome->text);
    else if (outcome->kind == Kind::no_ffmpeg)
      session_.messages().ask({Prompt::Kind::information,
                               "The frames are there, the film is not",
                               outcome->text,
                               {{"OK", {}, true}}});
    else
      session_.messages().report_error("The recording is not complete", outcome->text);
  }
  return news;
}

bool Capture::busy() const {
  const auto state = recorder_.state();
  const bool finishing = state == Recorder::State::writing || state == Recorder::State::encoding;
  return due_ || turning() || writer_.pending() > 0 || figure_.busy() || stepping_ || ending_ ||
         finishing;
}

void FilmMeshes::clear() {
  taken_ = Coordinates();
  moved_.clear();
}

/// Keeps what the job moves until its last mesh is collected, some frames after the job has ended.
void FilmMeshes::follow_motion(const Session& session) {
  const JobRunner& job = session.job();
  if (!job.active()) return;
  moved_.clear();
  if (!job.held()) moved_ = moved_as_bodies(job.command(), *session.topology());
}

std::vector<Coordinates> FilmMeshes::collect(const Session& session, bool between) {
  follow_motion(session);
  const Coordinates& now = session.coordinates();
  std::vector<Coordinates> meshes;
  if (between && taken_.size() == now.size())
    meshes = meshes_between(*session.topology(), moved_, taken_, now);
  meshes.push_back(now);
  if (!session.job().active() && taken_ == now) moved_.clear();
  taken_ = now;
  return meshes;
}

}  // namespace winslow::gui
