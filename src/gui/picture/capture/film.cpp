#include "gui/picture/capture/film.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "gui/files/file_kinds.h"

extern char** environ;

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> ffmpeg_arguments(const Film::Job& job, const fs::path& part) {
  const std::string rate = std::to_string(job.rate);
  std::vector<std::string> words{
      "-nostdin",   "-hide_banner", "-loglevel",     "error", "-progress", "pipe:1",        "-y",
      "-framerate", rate,           "-start_number", "1",     "-i",        "frame-%05d.png"};
  const auto add = [&words](std::initializer_list<const char*> more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  if (film_format(job.target) == FilmFormat::gif) {
    // A palette of the film's own colours: the format's default palette would show bands.
    add({"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=bayer", "-f",
         "gif"});
  } else {
    // Players need even sizes and this pixel format.
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", "-movflags",
         "+faststart", "-f", "mp4"});
  }
  words.push_back(part.string());
  return words;
}

/// The last lines of ffmpeg's output.
std::string last_words(const std::string& text) {
  constexpr std::size_t most = 600;
  std::string end = text.size() > most ? "..." + text.substr(text.size() - most) : text;
  while (!end.empty() && std::isspace(static_cast<unsigned char>(end.back()))) end.pop_back();
  return end;
}

}  // namespace

void check_film_name(const fs::path& path) {
  constexpr std::array others{".webm", ".mov",  ".avi", ".mkv", ".m4v",
                              ".mpg",  ".mpeg", ".wmv", ".ogv"};
  if (std::ranges::find(others, lower_case(path.extension().string())) == others.end()) return;
  throw UsageError("\"" + path.string() + "\": a film ends in .mp4 or .gif");
}

std::optional<FilmFormat> film_format(const fs::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".mp4") return FilmFormat::mp4;
  if (ending == ".gif") return FilmFormat::gif;
  return std::nullopt;
}

std::string frame_name(int k) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame-%05d.png", k);
  return name.data();
}

Film::Film(Job job) : job_(std::move(job)) {
  job_.target = fs::absolute(job_.target);
  part_ = job_.target;
  part_ += ".part";
  process_ =
      std::make_unique<ChildProcess>(job_.ffmpeg, ffmpeg_arguments(job_, part_), job_.folder);
}

Film::~Film() {
  process_.reset();
  std::error_code ignored;
  fs::remove(part_, ignored);
}

bool Film::poll() {
  if (ended_) return true;
  if (!process_->poll()) return false;
  ended_ = true;
  if (process_->status() != 0) {
    const std::string said = last_words(process_->errors());
    error_ = "ffmpeg ended with status " + std::to_string(process_->status()) +
             (said.empty() ? "." : ":\n" + said);
    return true;
  }
  std::error_code failed;
  fs::rename(part_, job_.target, failed);
  if (failed) error_ = job_.target.string() + ": " + failed.message();
  return true;
}

double Film::progress() const {
  // ffmpeg writes blocks of lines KEY=VALUE; the last frame=N counts.
  const std::string& said = process_->output();
  const std::size_t at = said.rfind("frame=");
  if (at == std::string::npos || job_.frames <= 0) return 0;
  return std::clamp(std::atof(said.c_str() + at + 6) / job_.frames, 0.0, 1.0);
}

namespace {

/// Longest output kept of a program; of longer output, the end is kept.
constexpr std::size_t most_text = 65536;

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    std::array<int, 2> ends{-1, -1};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw Error(std::string("cannot make a pipe: ") + std::strerror(errno));
    read = ends[0];
    write = ends[1];
    fcntl(read, F_SETFL, fcntl(read, F_GETFL) | O_NONBLOCK);
  }
  ~Pipe() {
    if (read >= 0) close(read);
    if (write >= 0) close(write);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take_read() { return std::exchange(read, -1); }
};

/// Appends what a pipe holds.
void drain(int pipe, std::string& text) {
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t got = read(pipe, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  if (text.size() > most_text) text.erase(0, text.size() - most_text);
}

}  // namespace

std::optional<std::filesystem::path> find_program(std::string_view name) {
  const char* variable = std::getenv("PATH");
  std::string_view rest = variable ? variable : "";
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    const std::filesystem::path folder(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    // The meaning of a relative folder would depend on where the program was started.
    if (!folder.is_absolute()) continue;
    const std::filesystem::path candidate = folder / name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(candidate, ignored) &&
        access(candidate.c_str(), X_OK) == 0)
      return candidate;
  }
  return std::nullopt;
}

ChildProcess::ChildProcess(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments,
                           const std::filesystem::path& folder) {
  Pipe out;
  Pipe err;
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write, STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  const int failed = posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw Error("cannot start " + program.string() + ": " + std::strerror(failed));
  out_ = out.take_read();
  err_ = err.take_read();
}

ChildProcess::~ChildProcess() {
  if (!ended_) {
    kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  close(out_);
  close(err_);
}

bool ChildProcess::poll() {
  if (ended_) return true;
  int how = 0;
  const pid_t got = waitpid(pid_, &how, WNOHANG);
  // The output from before the end is in the pipes by now.
  drain(out_, output_);
  drain(err_, errors_);
  if (got != pid_) return false;
  ended_ = true;
  status_ = WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how);
  return true;
}

}  // namespace winslow::gui
