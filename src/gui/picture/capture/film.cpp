#include "gui/picture/capture/film.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/error.h"

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
    // A palette of the film's own colours; that of the format would show bands.
    add({"-filter_complex", "split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=bayer", "-f",
         "gif"});
  } else {
    // Players want even sizes and this layout of colours.
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", "-movflags",
         "+faststart", "-f", "mp4"});
  }
  words.push_back(part.string());
  return words;
}

/// In small letters, with its dot.
std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// The last lines of what ffmpeg said.
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
  if (std::ranges::find(others, ending_of(path)) == others.end()) return;
  throw UsageError("\"" + path.string() + "\": a film ends in .mp4 or .gif");
}

std::optional<FilmFormat> film_format(const fs::path& path) {
  const std::string ending = ending_of(path);
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

}  // namespace winslow::gui
