#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "gui/render/image.h"

namespace winslow::gui {

/// Encodes pictures as PNG files on a thread of its own, in the order in which they came. The queue
/// is bounded: pictures are large.
class PictureWriter {
 public:
  explicit PictureWriter(std::size_t capacity = 8);
  /// Writes what is still in the queue, then returns.
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// False if push() would wait.
  bool has_room() const;
  /// Waits only where there is no room.
  void push(std::filesystem::path path, Image image, PngEffort effort = PngEffort::normal);
  /// Pictures not yet on disk.
  std::size_t pending() const;
  /// Forgets the pictures that are not yet being written.
  void discard();
  /// Waits until all is written.
  void flush();

  struct Outcome {
    std::filesystem::path path;
    std::string error;  ///< empty: written
  };
  /// What has been done since the last call.
  std::vector<Outcome> take_outcomes();

 private:
  struct Task {
    std::filesystem::path path;
    Image image;
    PngEffort effort = PngEffort::normal;
  };
  void work();

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Task> tasks_;
  std::vector<Outcome> outcomes_;
  bool writing_ = false, quit_ = false;
  std::thread worker_;  // last: it starts when everything else is there
};

}  // namespace winslow::gui
