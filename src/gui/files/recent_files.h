#pragma once

#include "gui/base/background.h"

namespace winslow::gui {

/// Meshes opened or saved last, the last one first. Whether they are still there is looked up on a
/// thread of its own.
class RecentFiles {
 public:
  struct File {
    std::filesystem::path path;  ///< absolute
    bool missing = false;

    bool operator==(const File&) const = default;
  };
  static constexpr std::size_t largest = 12;

  /// As kept in the settings.
  void set(const std::vector<std::string>& paths);
  std::vector<std::string> paths() const;

  /// Puts a file first.
  void add(const std::filesystem::path& path);
  void clear() { files_.clear(); }
  const std::vector<File>& files() const { return files_; }
  /// Folders of the files, without repetition.
  std::vector<std::filesystem::path> folders() const;

  /// Looks from time to time for files that have gone or come. seconds: since the last call.
  void update(double seconds);

 private:
  std::vector<File> files_;
  double since_look_ = 1e9;
  Background<std::vector<File>> look_;
};

/// A folder that one goes to often.
struct Place {
  std::string group;  ///< "Places", "Recent folders"
  std::string label;
  std::filesystem::path folder;
};
/// Home, desktop where there is one, the working folder, the bundled meshes; then recent folders.
std::vector<Place> places(const std::vector<std::filesystem::path>& recent);

std::filesystem::path home_folder();

}  // namespace winslow::gui
