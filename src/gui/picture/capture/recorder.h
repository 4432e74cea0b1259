#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "gui/picture/capture/film.h"
#include "gui/render/image.h"
#include "gui/settings/picture_spec.h"

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
  /// Blocks only if there is no room.
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
  /// The outcomes since the last call.
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

/// Records frames: writes them as PNG files and encodes a film of them. Independent of OpenGL and
/// of the studio. No function blocks.
class Recorder {
 public:
  enum class State {
    idle,
    recording,  ///< frames may come
    writing,    ///< no more frames; the remaining ones are being written
    encoding    ///< ffmpeg is at work
  };

  /// Begins a recording. Frames go into the folder `target`, or for a film NAME.mp4 or NAME.gif
  /// into the folder NAME-frames beside it. Throws OutputError if the folder cannot be made. Must
  /// be idle.
  void start(const std::filesystem::path& target, const RecordingSpec& spec);
  /// Folder of the frames of a target.
  static std::filesystem::path frames_folder(const std::filesystem::path& target);
  /// True if start() would replace existing files.
  static bool occupied(const std::filesystem::path& target);

  State state() const { return state_; }
  const RecordingSpec& spec() const { return spec_; }
  const std::filesystem::path& target() const { return target_; }
  int frames() const { return frames_; }    ///< taken so far
  int dropped() const { return dropped_; }  ///< left out since the disk was too slow
  /// Share done of what is being written or encoded, 0 to 1.
  double progress() const;

  /// True if there is room for a frame without blocking.
  bool has_room() const { return writer_ && writer_->has_room(); }
  /// All frames to come have this width and height.
  void fix_size(const std::array<int, 2>& size) { spec_.picture.size = size; }
  void add(Image frame);
  void drop() { ++dropped_; }
  /// Ends the recording; the film is made of its frames.
  void stop();
  /// Ends the recording at once and removes frames and film.
  void cancel();

  struct Outcome {
    enum class Kind { done, no_ffmpeg, failed };
    Kind kind = Kind::done;
    std::string text;  ///< what to tell the user
  };
  /// Advances writing and encoding. Returns the outcome of the recording once.
  std::optional<Outcome> poll();

 private:
  std::optional<Outcome> frames_written();
  Outcome finish(Outcome::Kind kind, std::string text);
  void remove_frames();
  std::string counted_frames() const;

  State state_ = State::idle;
  RecordingSpec spec_;
  std::filesystem::path target_, folder_;
  bool made_folder_ = false;
  int frames_ = 0, dropped_ = 0;
  std::string error_;  // of writing frames
  std::unique_ptr<PictureWriter> writer_;
  std::unique_ptr<Film> film_;
};

}  // namespace winslow::gui
