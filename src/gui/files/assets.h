#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace winslow::gui {

/// Folder of the bundled meshes: share/winslow beside the installed program's bin, or else the
/// source tree of the build. Empty if neither exists.
std::filesystem::path assets_folder();
/// The same for the program at a given path; for tests.
std::filesystem::path assets_folder(const std::filesystem::path& program);

/// Path of a bundled mesh below that folder or another. Volume meshes exist only in coarse
/// versions.
std::filesystem::path bundled_path(const std::filesystem::path& folder, const std::string& name);

/// True for paths below that folder, whose files belong to the program and are never overwritten.
bool bundled(const std::filesystem::path& path);
constexpr const char* bundled_text =
    "What comes with the program stays as it is. Choose another folder to write to.";

/// A mesh bundled with the program.
struct BundledMesh {
  std::string id;     ///< "naca0012"
  std::string file;   ///< name for bundled_path(): "naca0012.su2"
  std::string title;  ///< "NACA 0012"
  std::string about;  ///< a sentence
};
const std::vector<BundledMesh>& bundled_meshes();

}  // namespace winslow::gui
