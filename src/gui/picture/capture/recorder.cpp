#include "gui/picture/capture/recorder.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "gui/base/background.h"
#include "gui/base/text.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

/// Removes what an earlier recording left in a folder, and nothing else.
void remove_frames_in(const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> old;
  for (fs::directory_iterator it(folder, ignored), end; !ignored && it != end;
       it.increment(ignored))
    if (it->path().filename().string().starts_with("frame-") && it->path().extension() == ".png")
      old.push_back(it->path());
  for (const fs::path& path : old) fs::remove(path, ignored);
}

}  // namespace

fs::path Recorder::frames_folder(const fs::path& target) {
  if (!film_format(target)) return target;
  fs::path folder = target;
  return folder.replace_filename(target.stem().string() + "-frames");
}

bool Recorder::occupied(const fs::path& target) {
  std::error_code ignored;
  if (film_format(target) && fs::exists(target, ignored)) return true;
  const fs::path folder = frames_folder(target);
  return fs::exists(folder, ignored) && !fs::is_empty(folder, ignored);
}

void Recorder::start(const fs::path& target, const RecordingSpec& spec) {
  check_film_name(target);
  target_ = fs::absolute(target).lexically_normal();
  folder_ = frames_folder(target_);
  spec_ = spec;
  // A film has no transparent pixels.
  if (film_format(target_)) spec_.picture.transparent = false;
  std::error_code failed;
  made_folder_ = fs::create_directories(folder_, failed);
  if (failed || !fs::is_directory(folder_))
    throw OutputError(folder_.string() + ": this folder for the frames cannot be made" +
                      (failed ? ": " + failed.message() : ""));
  remove_frames_in(folder_);
  frames_ = dropped_ = 0;
  error_.clear();
  writer_ = std::make_unique<PictureWriter>();
  state_ = State::recording;
}

void Recorder::add(Image frame) {
  if (state_ != State::recording) return;
  writer_->push(folder_ / frame_name(++frames_), std::move(frame), PngEffort::little);
}

void Recorder::stop() {
  if (state_ == State::recording) state_ = State::writing;
}

void Recorder::remove_frames() {
  remove_frames_in(folder_);
  std::error_code ignored;
  if (made_folder_ && fs::is_empty(folder_, ignored)) fs::remove(folder_, ignored);
}

void Recorder::cancel() {
  if (state_ == State::idle) return;
  film_.reset();
  if (writer_) writer_->discard();
  writer_.reset();
  remove_frames();
  state_ = State::idle;
}

double Recorder::progress() const {
  if (state_ == State::encoding) return film_->progress();
  if (state_ != State::writing || frames_ == 0) return 0;
  return 1 - static_cast<double>(writer_->pending()) / frames_;
}

std::string Recorder::counted_frames() const {
  std::string text = counted(frames_, "frame");
  if (dropped_ > 0)
    text += " (" + grouped(dropped_) + " more were left out: the disk was too slow)";
  return text;
}

Recorder::Outcome Recorder::finish(Outcome::Kind kind, std::string text) {
  film_.reset();
  writer_.reset();
  state_ = State::idle;
  return {kind, std::move(text)};
}

std::optional<Recorder::Outcome> Recorder::poll() {
  if (state_ == State::idle) return std::nullopt;
  for (const auto& outcome : writer_->take_outcomes())
    if (error_.empty()) error_ = outcome.error;
  if (!error_.empty()) {
    writer_->discard();
    return finish(Outcome::Kind::failed, error_);
  }
  if (state_ == State::writing && writer_->pending() == 0) return frames_written();
  if (state_ != State::encoding || !film_->poll()) return std::nullopt;
  if (!film_->error().empty())
    return finish(Outcome::Kind::failed, "The " + counted_frames() + " are in " + folder_.string() +
                                             ", but no film could be made of them.\n\n" +
                                             film_->error());
  if (!spec_.keep_frames) remove_frames();
  return finish(Outcome::Kind::done,
                "Recorded " + counted_frames() + " to " + target_.filename().string());
}

std::optional<Recorder::Outcome> Recorder::frames_written() {
  // More outcomes may have come in since the last check.
  for (const auto& outcome : writer_->take_outcomes())
    if (!outcome.error.empty()) return finish(Outcome::Kind::failed, outcome.error);
  if (frames_ == 0) {
    remove_frames();
    return finish(Outcome::Kind::failed, "Nothing was recorded: the mesh did not move.");
  }
  if (!film_format(target_))
    return finish(Outcome::Kind::done, "Recorded " + counted_frames() + " to " + folder_.string());
  const auto ffmpeg = find_program("ffmpeg");
  if (!ffmpeg)
    return finish(
        Outcome::Kind::no_ffmpeg,
        "Films are made by the program ffmpeg, which is not installed (Debian: apt install "
        "ffmpeg). The " +
            counted_frames() + " are kept in " + folder_.string());
  try {
    film_ = std::make_unique<Film>(Film::Job{*ffmpeg, folder_, target_, frames_, spec_.rate});
  } catch (const Error& error) {
    return finish(Outcome::Kind::failed, "The " + counted_frames() + " are in " + folder_.string() +
                                             ", but no film could be made of them.\n\n" +
                                             error.what());
  }
  state_ = State::encoding;
  return std::nullopt;
}

PictureWriter::PictureWriter(std::size_t capacity)
    : capacity_(capacity), worker_([this] { work(); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

bool PictureWriter::has_room() const {
  const std::lock_guard lock(mutex_);
  return tasks_.size() < capacity_;
}

void PictureWriter::push(std::filesystem::path path, Image image, PngEffort effort) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return tasks_.size() < capacity_; });
  tasks_.push_back({std::move(path), std::move(image), effort});
  lock.unlock();
  changed_.notify_all();
}

std::size_t PictureWriter::pending() const {
  const std::lock_guard lock(mutex_);
  return tasks_.size() + (writing_ ? 1 : 0);
}

void PictureWriter::discard() {
  const std::lock_guard lock(mutex_);
  tasks_.clear();
}

void PictureWriter::flush() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return tasks_.empty() && !writing_; });
}

std::vector<PictureWriter::Outcome> PictureWriter::take_outcomes() {
  const std::lock_guard lock(mutex_);
  return std::exchange(outcomes_, {});
}

void PictureWriter::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return quit_ || !tasks_.empty(); });
    if (tasks_.empty()) return;
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    writing_ = true;
    lock.unlock();
    changed_.notify_all();
    Outcome outcome{task.path, error_of([&] { write_png(task.path, task.image, task.effort); })};
    lock.lock();
    outcomes_.push_back(std::move(outcome));
    writing_ = false;
    changed_.notify_all();
  }
}

}  // namespace winslow::gui
