#pragma once

#include "gui/base/background.h"

namespace winslow::gui {

/// Meshes opened or saved recently, the last one first. A separate thread checks whether they still
/// exist.
class RecentFiles {
 public:
  struct File {
    std::filesystem::path path;  ///< absolute
    bool missing = false;

    bool operator==(const File&) const = default;
  };
  static constexpr std::size_t largest = 12;

  /// The list as stored in the settings.
  void set(const std::vector<std::string>& paths);
  std::vector<std::string> paths() const;

  /// Moves or adds a file to the front.
  void add(const std::filesystem::path& path);
  void clear() { files_.clear(); }
  const std::vector<File>& files() const { return files_; }
  /// Folders of the files, without repetition.
  std::vector<std::filesystem::path> folders() const;

  /// Checks at intervals whether files exist. seconds: since the last call.
  void update(double seconds);

 private:
  std::vector<File> files_;
  double since_look_ = 1e9;
  Background<std::vector<File>> look_;
};

/// A frequently used folder.
struct Place {
  std::string group;  ///< "Places", "Recent folders"
  std::string label;
  std::filesystem::path folder;
};
/// Home, desktop if it exists, the working folder, the bundled meshes; then recent folders.
std::vector<Place> places(const std::vector<std::filesystem::path>& recent);

std::filesystem::path home_folder();

}  // namespace winslow::gui
