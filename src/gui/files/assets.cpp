#include "gui/files/assets.h"

#include <algorithm>
#include <system_error>

namespace winslow::gui {

namespace fs = std::filesystem;

const char* source_assets();  // in a source that CMake writes

fs::path assets_folder(const fs::path& program) {
  std::error_code ignored;
  fs::path installed = program.parent_path().parent_path() / "share" / "winslow";
  if (fs::is_regular_file(installed / "naca0012.su2", ignored)) return installed;
  const fs::path source = source_assets();
  return fs::is_directory(source, ignored) ? source : fs::path();
}

fs::path assets_folder() {
  static const fs::path folder = [] {
    std::error_code ignored;
    return assets_folder(fs::read_symlink("/proc/self/exe", ignored));
  }();
  return folder;
}

fs::path bundled_path(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  const fs::path coarse = folder / "coarse" / name;
  const bool only_coarse =
      !fs::is_regular_file(folder / name, ignored) && fs::is_regular_file(coarse, ignored);
  return only_coarse ? coarse : folder / name;
}

bool bundled(const fs::path& path) {
  if (assets_folder().empty()) return false;
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(assets_folder(), error);
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) return false;
  return std::mismatch(folder.begin(), folder.end(), whole.begin(), whole.end()).first ==
         folder.end();
}

const std::vector<BundledMesh>& bundled_meshes() {
  static const std::vector<BundledMesh> all{
      {"naca0012", "naca0012.su2", "NACA 0012", "9,388 triangles, far field at 100 chords."},
      {"three_element", "three_element.su2", "High lift",
       "26,897 triangles around slat, main element and flap."},
      {"circle", "circle.su2", "Circle", "4,802 triangles between two circles."},
      {"quads", "quads.su2", "Quadrilaterals", "2,528 quadrilaterals in a box around two bodies."},
      {"sphere", "sphere.su2.gz", "Sphere", "14,557 tetrahedra in a box around a sphere."},
      {"cube", "cube.su2.gz", "Cube", "14,426 tetrahedra in a box around a cube."},
      {"wing", "wing.su2.gz", "Wing",
       "18,435 tetrahedra around the slat, main element and flap of a swept wing."}};
  return all;
}

}  // namespace winslow::gui
