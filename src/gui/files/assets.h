#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace winslow::gui {

/// Folder of the bundled meshes: share/winslow beside the program's bin where it is installed, else
/// the source tree that it was built from. Empty if there is neither.
std::filesystem::path assets_folder();
/// The same for a program at a path; for tests.
std::filesystem::path assets_folder(const std::filesystem::path& program);

/// A bundled mesh by its name, below that folder or another: volume meshes are there as coarse ones
/// alone.
std::filesystem::path bundled_path(const std::filesystem::path& folder, const std::string& name);

/// True below that folder: what is there belongs to the program and is never written over.
bool bundled(const std::filesystem::path& path);
constexpr const char* bundled_text =
    "What comes with the program stays as it is. Choose another folder to write to.";

/// A mesh that comes with the program.
struct BundledMesh {
  std::string id;     ///< "naca0012"
  std::string file;   ///< as bundled_path() takes it: "naca0012.su2"
  std::string title;  ///< "NACA 0012"
  std::string about;  ///< a sentence
};
const std::vector<BundledMesh>& bundled_meshes();

}  // namespace winslow::gui
