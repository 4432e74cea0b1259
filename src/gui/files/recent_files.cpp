#include "gui/files/recent_files.h"

#include <algorithm>
#include <cstdlib>

#include "gui/files/assets.h"

namespace winslow::gui {

namespace {

constexpr double seconds_between_looks = 3;

}  // namespace

void RecentFiles::set(const std::vector<std::string>& paths) {
  files_.clear();
  for (const std::string& path : paths)
    if (files_.size() < largest) files_.push_back({path, false});
}

std::vector<std::string> RecentFiles::paths() const {
  std::vector<std::string> paths;
  for (const File& file : files_) paths.push_back(file.path.string());
  return paths;
}

void RecentFiles::add(const std::filesystem::path& path) {
  std::error_code failed;
  std::filesystem::path whole = std::filesystem::absolute(path, failed).lexically_normal();
  if (failed) whole = path;
  std::erase_if(files_, [&](const File& file) { return file.path == whole; });
  files_.insert(files_.begin(), {whole, false});
  if (files_.size() > largest) files_.pop_back();
}

std::vector<std::filesystem::path> RecentFiles::folders() const {
  std::vector<std::filesystem::path> folders;
  for (const File& file : files_) {
    const auto folder = file.path.parent_path();
    if (!file.missing && std::find(folders.begin(), folders.end(), folder) == folders.end())
      folders.push_back(folder);
  }
  return folders;
}

void RecentFiles::update(double seconds) {
  if (const auto looked = look_.poll())
    for (const File& found : *looked)
      for (File& file : files_)
        if (file.path == found.path) file.missing = found.missing;
  since_look_ += seconds;
  if (look_.busy() || files_.empty() || since_look_ < seconds_between_looks) return;
  since_look_ = 0;
  look_.start([files = files_]() mutable {
    for (File& file : files) {
      std::error_code failed;
      file.missing = !std::filesystem::exists(file.path, failed);
    }
    return files;
  });
}

namespace fs = std::filesystem;

namespace {

/// Looked up once, since these do not change while the studio runs.
const std::vector<Place>& fixed_places() {
  static const std::vector<Place> all = [] {
    std::error_code ignored;
    std::vector<Place> found{{"Places", "Home", home_folder()}};
    if (const fs::path desktop = home_folder() / "Desktop"; fs::is_directory(desktop, ignored))
      found.push_back({"Places", "Desktop", desktop});
    found.push_back({"Places", "Working folder", fs::current_path(ignored)});
    if (!assets_folder().empty()) found.push_back({"Places", "Bundled meshes", assets_folder()});
    found.push_back({"Places", "System", "/"});
    return found;
  }();
  return all;
}

/// The end of a path: its last `parts` names.
std::string end_of(const fs::path& folder, std::size_t parts) {
  std::string text;
  fs::path rest = folder;
  for (std::size_t k = 0; k < parts && rest.has_relative_path(); ++k) {
    text = rest.filename().string() + (text.empty() ? "" : "/" + text);
    rest = rest.parent_path();
  }
  return text.empty() ? folder.string() : text;
}

/// The shortest ends of the paths that distinguish them from each other.
std::vector<std::string> distinct_names(const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  constexpr std::size_t most = 12;
  for (const fs::path& folder : folders) {
    std::size_t parts = 1;
    const auto alike = [&] {
      return std::ranges::any_of(folders, [&](const fs::path& other) {
        return other != folder && end_of(other, parts) == end_of(folder, parts);
      });
    };
    while (parts < most && alike()) ++parts;
    names.push_back(end_of(folder, parts));
  }
  return names;
}

}  // namespace

fs::path home_folder() {
  const char* home = std::getenv("HOME");
  return home && *home ? fs::path(home) : fs::path("/");
}

std::vector<Place> places(const std::vector<fs::path>& recent) {
  std::vector<Place> all = fixed_places();
  constexpr std::size_t largest = 6;
  const std::vector<fs::path> shown(
      recent.begin(),
      recent.begin() + static_cast<std::ptrdiff_t>(std::min(recent.size(), largest)));
  const std::vector<std::string> names = distinct_names(shown);
  for (std::size_t k = 0; k < shown.size(); ++k)
    all.push_back({"Recent folders", names[k], shown[k]});
  return all;
}

}  // namespace winslow::gui
