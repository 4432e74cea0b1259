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

/// A child process, started without a shell and polled without blocking. The destructor ends it if
/// it still runs.
class ChildProcess {
 public:
  /// Runs a program in a folder; its standard input is empty. Throws Error if it cannot be started.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const std::filesystem::path& folder);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads its new output. True once it has ended.
  bool poll();
  /// Exit status, or 128 + signal if a signal ended it. Valid once it has ended.
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

/// Format of a film by the extension of its file, .mp4 or .gif; none for anything else.
enum class FilmFormat { mp4, gif };
std::optional<FilmFormat> film_format(const std::filesystem::path& path);
/// Throws UsageError for the extension of another film format: frames would go to a folder of that
/// name.
void check_film_name(const std::filesystem::path& path);

/// Name of the k-th frame, counted from 1: "frame-00001.png".
std::string frame_name(int k);

/// Encodes the frames in a folder as a film with ffmpeg, in the background.
class Film {
 public:
  struct Job {
    std::filesystem::path ffmpeg;  ///< the program
    std::filesystem::path folder;  ///< of the frames
    std::filesystem::path target;  ///< .mp4 or .gif; replaced when the film is complete
    int frames = 0;
    int rate = 20;  ///< frames a second
  };
  /// Throws Error if ffmpeg cannot be started.
  explicit Film(Job job);
  /// Removes an incomplete film.
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// True once the encoding has ended.
  bool poll();
  /// Share of the frames done, 0 to 1.
  double progress() const;
  /// What went wrong, empty if nothing did. Valid once the encoding has ended.
  const std::string& error() const { return error_; }

 private:
  Job job_;
  std::filesystem::path part_;  // the film until it is complete
  std::unique_ptr<ChildProcess> process_;
  bool ended_ = false;
  std::string error_;
};

}  // namespace winslow::gui
