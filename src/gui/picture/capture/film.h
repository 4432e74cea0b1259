#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace winslow::gui {

/// A program of that name in the folders of PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// Another program, started without a shell and watched without waiting for it. Ended, if it still
/// runs, when this object goes.
class ChildProcess {
 public:
  /// Runs a program in a folder; its standard input is empty. Throws Error if it cannot be started.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const std::filesystem::path& folder);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads what it has said since. True once it has ended.
  bool poll();
  /// Exit status, 128 + signal if a signal ended it. After it has ended.
  int status() const { return status_; }
  const std::string& output() const { return output_; }
  const std::string& errors() const { return errors_; }

 private:
  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
  bool ended_ = false;
  int status_ = 0;
  std::string output_, errors_;
};

/// What frames are made into: by the ending of a file's name, .mp4 or .gif; none for anything else.
enum class FilmFormat { mp4, gif };
std::optional<FilmFormat> film_format(const std::filesystem::path& path);
/// Throws UsageError for the ending of a film of another format: frames would go to a folder of
/// that name.
void check_film_name(const std::filesystem::path& path);

/// Name of the k-th frame, counted from 1: "frame-00001.png".
std::string frame_name(int k);

/// Frames in a folder being made into a film by ffmpeg, in the background.
class Film {
 public:
  struct Job {
    std::filesystem::path ffmpeg;  ///< the program
    std::filesystem::path folder;  ///< of the frames
    std::filesystem::path target;  ///< .mp4 or .gif; replaced when the film is whole
    int frames = 0;
    int rate = 20;  ///< frames a second
  };
  /// Throws Error if ffmpeg cannot be started.
  explicit Film(Job job);
  /// A film that is not whole is removed.
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// True once it has ended.
  bool poll();
  /// Share of the frames done, 0 to 1.
  double progress() const;
  /// What went wrong, empty if nothing did. After it has ended.
  const std::string& error() const { return error_; }

 private:
  Job job_;
  std::filesystem::path part_;  // the film until it is whole
  std::unique_ptr<ChildProcess> process_;
  bool ended_ = false;
  std::string error_;
};

}  // namespace winslow::gui
