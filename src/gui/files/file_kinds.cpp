#include "gui/files/file_kinds.h"

#include <sys/stat.h>

#include <cctype>

#include "io/format/mesh_format.h"
#include "io/tables/table_files.h"

namespace winslow::gui {

namespace {

/// The available formats: those that can write such a mesh, or all.
std::vector<FileKind> mesh_kinds(std::optional<MeshKind> to_write) {
  std::vector<FileKind> kinds{{"All meshes", {}}};
  for (const io::MeshFormat* format : io::mesh_formats()) {
    if (!format->missing.empty()) continue;
    if (to_write && !format->can_write(*to_write)) continue;
    // Meshes that are folders have no extension: their names are typed.
    if (to_write && format->folder_to_write) continue;
    const std::string extension = '.' + std::string(format->name);
    kinds.front().extensions.push_back(extension);
    kinds.push_back({std::string(format->title), {extension}});
  }
  return kinds;
}

DialogKind saving(const char* title, const char* button, std::vector<FileKind> kinds,
                  const char* extension = "") {
  return {title, button, true, std::move(kinds), extension};
}

DialogKind opening(const char* title, const char* button, std::vector<FileKind> kinds) {
  kinds.push_back({"All files", {}});
  return {title, button, false, std::move(kinds), ""};
}

}  // namespace

DialogKind dialog_of(FilePurpose purpose, MeshKind kind) {
  switch (purpose) {
    case FilePurpose::open_mesh:
      return opening("Open a mesh", "Open", mesh_kinds({}));
    case FilePurpose::save_mesh:
      return saving("Save the mesh as", "Save", mesh_kinds(kind));
    case FilePurpose::export_mesh:
      return saving("Export a copy of the mesh", "Export", mesh_kinds(kind));
    case FilePurpose::export_markers:
      return saving("Export markers as curves", "Export",
                    {{"All curves", io::boundary_extensions()},
                     {"Table", {".csv"}},
                     {"Points", {".dat"}},
                     {"VTK lines", {".vtk"}}},
                    ".csv");
    case FilePurpose::export_recipe:
      return saving("Export the recipe", "Save", {{"Recipes", {".json"}}}, ".json");
    case FilePurpose::replay_recipe:
      return opening("Replay a recipe on this mesh", "Replay", {{"Recipes", {".json"}}});
    case FilePurpose::export_convergence:
      return saving("Export the iterations as CSV", "Save", {{"Tables", {".csv"}}}, ".csv");
    case FilePurpose::picture:
      return saving("Save a picture: .png, or the mesh alone as .svg or .pdf", "Save",
                    {{"All pictures", {".png", ".svg", ".pdf"}},
                     {"PNG", {".png"}},
                     {"SVG", {".svg"}},
                     {"PDF", {".pdf"}}},
                    ".png");
    case FilePurpose::recording: {
      DialogKind film =
          saving("Record to a film (.mp4, .gif), or to a folder of frames", "Record",
                 {{"All films", {".mp4", ".gif"}}, {"MP4", {".mp4"}}, {"GIF", {".gif"}}});
      film.folders = true;
      return film;
    }
    case FilePurpose::displacements:
      return opening("Displacements of nodes: node,dx,dy or x,y,dx,dy, in space with z and dz",
                     "Displace", {{"Tables", {".csv", ".txt", ".dat"}}, {"All files", {}}});
    case FilePurpose::positions:
      return opening("Positions of nodes: node,x,y, in space with z", "Move",
                     {{"Tables", {".csv", ".txt", ".dat"}}, {"All files", {}}});
    case FilePurpose::reference:
    case FilePurpose::step_reference:
      return opening("A surface for nodes to slide on", "Use", mesh_kinds({}));
  }
  return {};
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string extension_of(const std::string& name) {
  const std::filesystem::path path(name);
  const std::string last = lower_case(path.extension().string());
  return last == ".gz" ? lower_case(path.stem().extension().string()) : last;
}

bool matches(const FileKind& kind, const std::string& name) {
  return kind.extensions.empty() || std::find(kind.extensions.begin(), kind.extensions.end(),
                                              extension_of(name)) != kind.extensions.end();
}

std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return FileStamp{
      static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino),
      static_cast<std::uint64_t>(found.st_size), static_cast<std::int64_t>(found.st_mtim.tv_sec),
      static_cast<std::int64_t>(found.st_mtim.tv_nsec)};
}

}  // namespace winslow::gui
