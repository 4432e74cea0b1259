#include "gui/picture/capture/picture_writer.h"

#include <exception>
#include <utility>

namespace winslow::gui {

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
    Outcome outcome{task.path, {}};
    try {
      write_png(task.path, task.image, task.effort);
    } catch (const std::bad_alloc&) {
      outcome.error = "There is not enough memory.";
    } catch (const std::exception& error) {
      outcome.error = error.what();
    }
    lock.lock();
    outcomes_.push_back(std::move(outcome));
    writing_ = false;
    changed_.notify_all();
  }
}

}  // namespace winslow::gui
