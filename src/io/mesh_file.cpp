#include "io/mesh_file.h"

#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/format_detection.h"
#include "io/gmsh/gmsh.h"
#include "io/parsed_mesh.h"
#include "io/su2/su2.h"
#include "io/surface/surface.h"
#include "io/vtk/legacy.h"
#include "io/vtk/vtu.h"

namespace winslow::io {
namespace {

/// Content wins over the extension; the extension decides only where the content says nothing.
Format detect(const Source& source, const std::filesystem::path& path,
              std::vector<std::string>& warnings) {
  const auto by_extension = format_of_extension(path);
  const auto by_content = format_of_content(source.text());
  if (!by_extension && !by_content) {
    source.fail(0, "a file of unknown format", "a mesh (" + supported_extensions() + ")");
  }
  if (by_extension && by_content && by_extension != by_content) {
    warnings.push_back("the content is that of a ." + std::string(format_name(*by_content)) +
                       " file, not of a ." + std::string(format_name(*by_extension)) +
                       " file: read as such");
  }
  return by_content ? *by_content : *by_extension;
}

ParsedMesh parse(Source& source, Format format) {
  switch (format) {
    case Format::su2:
      return su2::read(source);
    case Format::gmsh:
      return gmsh::read(source);
    case Format::vtk:
      return vtk::read_legacy(source);
    case Format::vtu:
      return vtk::read_vtu(source);
    case Format::obj:
      return surface::read_obj(source);
    case Format::off:
      return surface::read_off(source);
    case Format::ply:
      return surface::read_ply(source);
    case Format::stl:
      return surface::read_stl(source);
  }
  throw UsageError("unknown mesh format");
}

/// The place in the file of what an error of make_mesh is about.
std::size_t place_of(const MeshError& error, const SourceMap& where) {
  const auto at = [](const std::vector<std::size_t>& offsets, Index i) {
    const auto k = static_cast<std::size_t>(i);
    return i >= 0 && k < offsets.size() ? offsets[k] : std::size_t{0};
  };
  switch (error.entity()) {
    case MeshEntity::node:
      return at(where.nodes, error.index());
    case MeshEntity::element:
      return at(where.elements, error.index());
    case MeshEntity::marker_face: {
      const auto m = static_cast<std::size_t>(error.marker());
      return error.marker() >= 0 && m < where.marker_edges.size()
                 ? at(where.marker_edges[m], error.index())
                 : 0;
    }
    case MeshEntity::mesh:
      break;
  }
  return 0;
}

std::vector<std::string> write(std::ostream& out, Format format, const Mesh& mesh,
                               const FormatDetails* details, const WriteOptions& options) {
  const bool as_source = options.keep_encoding && details != nullptr && details->format == format;
  const bool binary = options.binary || (as_source && details->binary);
  switch (format) {
    case Format::su2:
      return su2::write(out, mesh, dynamic_cast<const su2::Details*>(details));
    case Format::gmsh: {
      const auto* own = dynamic_cast<const gmsh::Details*>(details);
      const bool newest = own == nullptr || own->version_4;
      const bool version_4 = options.gmsh_version.empty() ? newest : options.gmsh_version == "4.1";
      return gmsh::write(out, mesh, details, {version_4, binary});
    }
    case Format::vtk:
      return vtk::write_legacy(out, mesh, details, binary);
    case Format::vtu:
      return vtk::write_vtu(out, mesh, details, binary);
    case Format::obj:
      return surface::write_obj(out, mesh, details);
    case Format::off:
      return surface::write_off(out, mesh, details);
    case Format::ply:
      return surface::write_ply(out, mesh, details, binary);
    case Format::stl:
      return surface::write_stl(out, mesh, details, binary);
  }
  throw UsageError("unknown mesh format");
}

}  // namespace

MeshFile read_mesh(const std::filesystem::path& path) {
  Source source = Source::load(path);
  MeshFile file;
  file.format = detect(source, path, file.warnings);
  ParsedMesh parsed = parse(source, file.format);
  file.warnings.insert(file.warnings.end(), parsed.warnings.begin(), parsed.warnings.end());
  try {
    file.mesh = make_mesh(parsed.data, &file.warnings);
  } catch (const MeshError& error) {
    source.fail(place_of(error, parsed.where), error.what());
  }
  parsed.details->format = file.format;
  file.details = std::move(parsed.details);
  for (std::string& warning : file.warnings) warning = source.name() + ": " + warning;
  return file;
}

std::vector<std::string> write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                                    const FormatDetails* details, const WriteOptions& options) {
  const auto format = options.format ? options.format : format_of_extension(path);
  if (!format) {
    throw UsageError(path.string() + ": unknown file format, expected one of " +
                     supported_extensions());
  }
  if (!options.gmsh_version.empty() && options.gmsh_version != "2.2" &&
      options.gmsh_version != "4.1") {
    throw UsageError("unknown MSH version \"" + options.gmsh_version + "\", expected 2.2 or 4.1");
  }
  std::vector<std::string> warnings;
  write_atomically(
      path, [&](std::ostream& out) { warnings = write(out, *format, mesh, details, options); });
  for (std::string& warning : warnings) warning = path.string() + ": " + warning;
  return warnings;
}

}  // namespace winslow::io
