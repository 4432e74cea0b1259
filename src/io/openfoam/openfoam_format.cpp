#include <algorithm>
#include <system_error>

#include "io/openfoam/openfoam.h"

namespace winslow::io::openfoam {
namespace {

namespace fs = std::filesystem;

bool holds_mesh(const fs::path& folder) {
  std::error_code error;
  const auto has = [&](const char* name) {
    return fs::exists(folder / name, error) ||
           fs::exists(folder / (std::string(name) + ".gz"), error);
  };
  return has("points") && has("faces");
}

fs::path find_folder(const fs::path& path) {
  std::error_code error;
  const bool is_folder = fs::is_directory(path, error);
  if (!is_folder && path.extension() != ".foam") return {};
  const fs::path start = is_folder ? path : path.parent_path();
  for (const fs::path& folder : {start, start / "polyMesh", start / "constant" / "polyMesh"}) {
    if (holds_mesh(folder)) return folder;
  }
  // A file .foam is empty: only the folder that it stands for can be what is missing.
  return is_folder ? fs::path() : start / "constant" / "polyMesh";
}

}  // namespace

bool Details::fits(const Mesh& mesh) const {
  const Topology& topology = *mesh.topology;
  if (nodes != topology.node_count() || elements != topology.element_count()) return false;
  if (!topology.markers().from_file()) return markers.empty();
  return std::ranges::equal(
      topology.markers().list(), markers,
      [](const Marker& a, const Marker& b) { return a.name == b.name && a.faces == b.faces; });
}

const MeshFormat format{.name = "foam",
                        .title = "OpenFOAM",
                        .versions = "the folder polyMesh",
                        .encodings = "text",
                        .markers = "yes, by name (patches)",
                        .regions = "no",
                        .quadrilaterals = "no plane meshes",
                        .volumes = "yes",
                        .folder_name = "polyMesh",
                        .writes_planes = false,
                        .writes_volumes = true,
                        .keeps_markers = true,
                        .recognise = [](const Content&) { return Evidence{}; },
                        .read = read,
                        .find_folder = find_folder,
                        .files = files};

}  // namespace winslow::io::openfoam
