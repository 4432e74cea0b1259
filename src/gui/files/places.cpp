#include "gui/files/places.h"

#include <cstdlib>
#include <system_error>

#include "gui/files/assets.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

/// Looked up once: none of these comes and goes while the studio runs.
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

}  // namespace

fs::path home_folder() {
  const char* home = std::getenv("HOME");
  return home && *home ? fs::path(home) : fs::path("/");
}

std::vector<Place> places(const std::vector<fs::path>& recent) {
  std::vector<Place> all = fixed_places();
  constexpr std::size_t largest = 6;
  for (const fs::path& folder : recent) {
    if (all.size() >= fixed_places().size() + largest) break;
    const std::string name = folder.filename().string();
    all.push_back({"Recent folders", name.empty() ? folder.string() : name, folder});
  }
  return all;
}

}  // namespace winslow::gui
