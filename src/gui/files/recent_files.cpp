#include "gui/files/recent_files.h"

#include <algorithm>
#include <system_error>

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

}  // namespace winslow::gui
