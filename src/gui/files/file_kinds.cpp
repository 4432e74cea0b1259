#include "gui/files/file_kinds.h"

#include <sys/stat.h>

#include <cctype>

#include "io/format/mesh_format.h"
#include "io/tables/table_files.h"

namespace winslow::gui {

namespace {

/// Formats that are there; those that can be written, of such a mesh, or all.
std::vector<FileKind> mesh_kinds(std::optional<MeshKind> to_write) {
  std::vector<FileKind> kinds{{"All meshes", {}}};
  for (const io::MeshFormat* format : io::mesh_formats()) {
    if (!format->missing.empty()) continue;
    if (to_write && !format->can_write(*to_write)) continue;
    const std::string extension = '.' + std::string(format->name);
    kinds.front().extensions.push_back(extension);
    kinds.push_back({std::string(format->title), {extension}});
  }
  return kinds;
}

DialogKind single(const char* title, const char* label, const char* extension) {
  return {title, "Save", true, {{label, {extension}}}, extension};
}

}  // namespace

DialogKind dialog_of(FilePurpose purpose, MeshKind kind) {
  switch (purpose) {
    case FilePurpose::open_mesh: {
      DialogKind open{"Open a mesh", "Open", false, mesh_kinds({}), ""};
      open.kinds.push_back({"All files", {}});
      return open;
    }
    case FilePurpose::save_mesh:
      return {"Save the mesh as", "Save", true, mesh_kinds(kind), ""};
    case FilePurpose::export_mesh:
      return {"Export a copy of the mesh", "Export", true, mesh_kinds(kind), ""};
    case FilePurpose::export_markers:
      return {"Export markers as curves",
              "Export",
              true,
              {{"All curves", io::boundary_extensions()},
               {"Table", {".csv"}},
               {"Points", {".dat"}},
               {"VTK lines", {".vtk"}}},
              ".csv"};
    case FilePurpose::export_recipe:
      return single("Export the recipe", "Recipes", ".json");
    case FilePurpose::replay_recipe:
      return {"Replay a recipe on this mesh",
              "Replay",
              false,
              {{"Recipes", {".json"}}, {"All files", {}}},
              ""};
    case FilePurpose::export_convergence:
      return single("Export the iterations as CSV", "Tables", ".csv");
    case FilePurpose::picture:
      return {"Save a picture: .png, or the mesh alone as .svg or .pdf",
              "Save",
              true,
              {{"All pictures", {".png", ".svg", ".pdf"}},
               {"PNG", {".png"}},
               {"SVG", {".svg"}},
               {"PDF", {".pdf"}}},
              ".png"};
    case FilePurpose::recording:
      return {"Record to a film (.mp4, .gif), or to a folder of frames",
              "Record",
              true,
              {{"All films", {".mp4", ".gif"}}, {"MP4", {".mp4"}}, {"GIF", {".gif"}}},
              "",
              true};
    case FilePurpose::reference:
    case FilePurpose::step_reference: {
      DialogKind surface{"A surface for nodes to slide on", "Use", false, mesh_kinds({}), ""};
      surface.kinds.push_back({"All files", {}});
      return surface;
    }
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
