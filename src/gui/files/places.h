#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace winslow::gui {

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
