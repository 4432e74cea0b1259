#include "io/format/mesh_file.h"

#include <iterator>
#include <tuple>

#include "core/error.h"
#include "io/file/atomic_file.h"
#include "io/file/gzip.h"
#include "io/format/foreign_formats.h"
#include "io/format/mesh_format.h"
#include "io/format/mesh_repair.h"
#include "io/format/periodicity.h"

namespace winslow::io {

namespace {

struct Named {
  Face nodes;
  std::size_t marker;
};

std::string counted(std::size_t n, const char* what) {
  return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
}

/// Sentences about edges that a marker names twice, or that two markers share. They are no error,
/// but solvers accept only one boundary condition per edge.
std::vector<std::string> marker_overlaps(const Topology& topology) {
  if (!topology.markers().from_file()) return {};
  std::vector<Named> all;
  const auto& markers = topology.markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    for (const Face& face : markers[m].faces) all.push_back({face.sorted(), m});
  }
  std::sort(all.begin(), all.end(), [](const Named& a, const Named& b) {
    return std::tie(a.nodes, a.marker) < std::tie(b.nodes, b.marker);
  });
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> pairs;
  for (std::size_t k = 1; k < all.size(); ++k) {
    if (all[k].nodes == all[k - 1].nodes) ++pairs[{all[k - 1].marker, all[k].marker}];
  }
  const char* what = side_name(topology.cell_dimension());
  std::vector<std::string> warnings;
  for (const auto& [pair, n] : pairs) {
    const std::string& first = markers[pair.first].name;
    if (pair.first == pair.second) {
      warnings.push_back("marker \"" + first + "\" names " + counted(n, what) + " again");
    } else {
      warnings.push_back("markers \"" + first + "\" and \"" + markers[pair.second].name +
                         "\" share " + counted(n, what));
    }
  }
  return warnings;
}

/// Detects the format by content; the extension decides only if the content is not conclusive.
const MeshFormat* detect(const Source& source, const std::filesystem::path& path,
                         std::vector<std::string>& warnings) {
  if (const ForeignFormat* foreign = foreign_format_of(Content(source.text()), path))
    source.fail(0, refusal_of(*foreign, path));
  const MeshFormat* by_extension = format_of_extension(path);
  const MeshFormat* by_content = format_of_content(source.text());
  if (!by_extension && !by_content) {
    source.fail(0, "a file of unknown format", "a mesh (" + supported_extensions() + ")");
  }
  if (by_extension && by_content && by_extension != by_content) {
    warnings.push_back("the content is that of a ." + std::string(by_content->name) +
                       " file, not of a ." + std::string(by_extension->name) +
                       " file: read as such");
  }
  return by_content ? by_content : by_extension;
}

/// The place in the file that caused an error of make_mesh.
std::size_t place_of(const MeshError& error, const SourceMap& where) {
  const auto offset = [](const std::vector<std::size_t>& offsets, Index i) {
    const auto k = static_cast<std::size_t>(i);
    return i >= 0 && k < offsets.size() ? offsets[k] : std::size_t{0};
  };
  switch (error.entity()) {
    case MeshEntity::node:
      return offset(where.nodes, error.index());
    case MeshEntity::element:
      return offset(where.elements, error.index());
    case MeshEntity::marker_face: {
      const auto m = static_cast<std::size_t>(error.marker());
      return error.marker() >= 0 && m < where.marker_edges.size()
                 ? offset(where.marker_edges[m], error.index())
                 : 0;
    }
    case MeshEntity::mesh:
      break;
  }
  return 0;
}

/// "OpenFOAM (foam), VTK (vtu)": those that can hold something.
std::string formats_with(bool MeshFormat::*something) {
  std::string text;
  for (const MeshFormat* format : mesh_formats())
    if (format->*something && format->missing.empty())
      text += (text.empty() ? "" : ", ") + std::string(format->title) + " (" +
              std::string(format->name) + ")";
  return text;
}

/// Throws UsageError for elements of a type that a format cannot hold.
void refuse_elements(const std::filesystem::path& path, const Topology& topology,
                     const MeshFormat& format, ElementType type, const char* one, const char* many,
                     bool MeshFormat::*something) {
  const auto types = topology.element_types();
  const auto count = std::ranges::count(types, type);
  throw UsageError(path.string() + ": " + std::string(format.title) + " files cannot hold the " +
                   std::to_string(count) + ' ' + (count == 1 ? one : many) + " of this mesh of " +
                   counted(types.size(), "element") +
                   "; formats that can: " + formats_with(something));
}

void check_dimension(const std::filesystem::path& path, const Topology& topology,
                     const MeshFormat& format) {
  if (topology.has_polyhedra() && !format.polyhedra)
    refuse_elements(path, topology, format, ElementType::polyhedron, "polyhedron", "polyhedra",
                    &MeshFormat::polyhedra);
  if (topology.has_polygons() && !format.polygons)
    refuse_elements(path, topology, format, ElementType::polygon, "polygon", "polygons",
                    &MeshFormat::polygons);
  if (format.can_write(topology.kind())) return;
  throw UsageError(path.string() + ": " + std::string(format.title) + " files cannot hold a " +
                   std::string(mesh_kind(topology)));
}

/// Whether repair() makes a sound mesh of this one.
bool is_mended(ParsedMesh mesh, const Source& source) {
  if (repair(mesh, source).empty()) return false;
  try {
    winslow::make_mesh(mesh.data);
    return true;
  } catch (const MeshError&) {
    return false;
  }
}

/// Makes of polygons what they are: triangles, quadrilaterals, and others, among them
/// quadrilaterals with a flat corner. Readers make polygons of all that may be one.
void settle_polygons(MeshData& data) {
  for (Index e = 0; e < data.element_count(); ++e) {
    ElementType& type = data.types[at(e)];
    if (type != ElementType::polygon) continue;
    const auto corners = data.element(e);
    const bool known = std::ranges::all_of(
        corners, [&](Index node) { return node >= 0 && node < data.node_count(); });
    if (corners.size() == 3) type = ElementType::triangle;
    if (corners.size() != 4 || !known) continue;
    if (data.coordinates.dimension() == 2) {
      std::vector<Vec2> places = places_of(data.coordinates, corners);
      if (signed_area2(data.coordinates, corners) < 0) std::ranges::reverse(places);
      if (corners_of_polygon(places).real != 4) continue;
    }
    type = ElementType::quadrilateral;
  }
}

/// Makes the mesh of a file. A mesh to be shown need not be sound.
void build_mesh(const Source& source, const ReadOptions& options, ParsedMesh& parsed,
                MeshFile& file) {
  std::size_t place = 0;
  std::string fault;
  bool mends = false;
  try {
    file.mesh = make_mesh(parsed.data, &file.warnings);
    return;
  } catch (const MeshError& error) {
    place = place_of(error, parsed.where);
    fault = error.what();
    mends = options.defects != Defects::repair && is_mended(parsed, source);
  }
  if (options.defects != Defects::show) {
    if (mends) throw MendableError(source.where(place) + ": " + fault);
    source.fail(place, fault);
  }
  file.defective = true;
  file.warnings.push_back(source.place(place) + ": " + fault +
                          (mends ? "; --repair mends it" : "") +
                          "; shown all the same, but smooth and move refuse such a mesh");
  const auto built = [&] {
    try {
      file.mesh = {Topology::build(parsed.data), parsed.data.coordinates};
      return true;
    } catch (const MeshError&) {
      return false;
    }
  };
  if (built()) return;
  for (const std::string& text : leave_out_defects(parsed, source))
    file.warnings.push_back("to show the mesh: " + text);
  if (!built()) source.fail(place, fault);
}

/// A mesh file before its content is read.
struct OpenedMesh {
  OpenedMesh(const std::filesystem::path& mesh, const std::string& time)
      : path(mesh),
        format(format_of_folder(mesh)),
        source(format ? Source(format->find_folder(mesh, time).string(), {}) : Source::load(mesh)) {
    if (!format && !time.empty())
      throw UsageError(path.string() + ": has no times (--time), which are for cases of OpenFOAM");
    if (!format) format = detect(source, path, warnings);
    if (!format->missing.empty())
      throw InputError(source.name() + ": " + std::string(format->missing));
  }

  std::filesystem::path path;
  const MeshFormat* format;
  Source source;
  std::vector<std::string> warnings;  ///< of the whole file
};

/// Makes the mesh of what a reader has found.
MeshFile finish(const OpenedMesh& opened, const ReadOptions& options, ParsedMesh parsed,
                std::vector<std::string> warnings) {
  MeshFile file;
  file.format = opened.format;
  file.warnings = std::move(warnings);
  turn_to_viewer(parsed);
  settle_polygons(parsed.data);
  file.warnings.insert(file.warnings.end(), parsed.warnings.begin(), parsed.warnings.end());
  if (options.defects == Defects::repair) {
    const auto mended = repair(parsed, opened.source);
    for (const std::string& text : mended) file.warnings.push_back("repaired: " + text);
    if (mended.empty()) file.warnings.emplace_back("repair: nothing to mend was found");
  }
  build_mesh(opened.source, options, parsed, file);
  parsed.details->nodes = file.mesh.topology->node_count();
  parsed.details->elements = file.mesh.topology->element_count();
  for (std::string& text : marker_overlaps(*file.mesh.topology))
    file.warnings.push_back(std::move(text));
  parsed.details->format = file.format;
  const std::string& name = opened.source.name();
  settle_periodicity(*parsed.details, file.mesh, name);
  file.details = std::move(parsed.details);
  const std::string zone =
      file.details->zones.empty() ? "" : "zone " + std::to_string(file.details->zone) + ": ";
  for (std::string& warning : file.warnings) warning = name + ": " + zone + warning;
  return file;
}

/// Throws UsageError for an option that a format has no use for.
void check_options(const OpenedMesh& opened, const ReadOptions& options) {
  const MeshFormat& format = *opened.format;
  const std::string& name = opened.source.name();
  if (options.zone != 0 && !format.read_zone) {
    throw UsageError(name + ": no zone " + std::to_string(options.zone) +
                     ": a file of this format is one mesh");
  }
  if (!options.regions.empty() && !format.read_arrays) {
    throw UsageError(name + ": no cell array \"" + options.regions + "\": " +
                     std::string(format.title) + " files hold no arrays that could be regions");
  }
}

/// Reads the zone that the options name, or the whole file.
ParsedMesh parse(OpenedMesh& opened, const ReadOptions& options) {
  const MeshFormat& format = *opened.format;
  if (format.read_folder) return format.read_folder(opened.source, opened.path, options.time);
  if (format.read_arrays) return format.read_arrays(opened.source, options.regions);
  if (format.read_zone) return format.read_zone(opened.source, options.zone);
  return format.read(opened.source);
}

/// Sentences about what a source holds and a format cannot hold.
std::vector<std::string> losses(const MeshFormat& format, const FormatDetails& details) {
  std::vector<std::string> warnings;
  if (details.periodic && !format.keeps_periodic) {
    if (const std::string names = named_pairs(*details.periodic); !names.empty())
      warnings.push_back("the periodic pairs of the source (" + names + ") are not written");
  }
  if (!format.keeps_data && !details.data_names().empty())
    warnings.push_back("data on points, cells and the field are not written: " +
                       details.data_names());
  return warnings;
}

}  // namespace

MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
  OpenedMesh opened(path, options.time);
  check_options(opened, options);
  ParsedMesh parsed = parse(opened, options);
  return finish(opened, options, std::move(parsed), std::move(opened.warnings));
}

std::vector<MeshFile> read_mesh_zones(const std::filesystem::path& path,
                                      const ReadOptions& options) {
  std::vector<MeshFile> files;
  OpenedMesh opened(path, options.time);
  ReadOptions whole = options;
  whole.zone = 0;
  check_options(opened, whole);
  const auto take = [&](ParsedMesh zone) {
    files.push_back(finish(opened, options, std::move(zone), std::exchange(opened.warnings, {})));
  };
  if (opened.format->read_zones)
    opened.format->read_zones(opened.source, take);
  else
    take(parse(opened, whole));
  return files;
}

std::vector<std::string> zones_left(const FormatDetails* details,
                                    const std::filesystem::path& path) {
  if (!details || details->zones.size() < 2) return {};
  const std::string numbers =
      list_of(details->zones, [](int number) { return std::to_string(number); });
  return {path.string() + ": has " + std::to_string(details->zones.size()) + " zones (" + numbers +
          "); this is zone " + std::to_string(details->zone) + ", --zone N opens another"};
}

bool keeps_zones(const std::filesystem::path& path, const FormatDetails& details) {
  const MeshFormat* format = format_of_output(path, details.format);
  return format != nullptr && format->write_zones && format == details.format;
}

std::vector<std::string> write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                                    const FormatDetails* details, const WriteOptions& options) {
  const MeshZone zone{&mesh, details};
  return write_mesh_zones(path, {&zone, 1}, options);
}

bool copy_mesh(const std::filesystem::path& from, const std::filesystem::path& to,
               const FormatDetails* details, const WriteOptions& options) {
  const MeshFormat* format = options.format ? options.format : format_of_extension(to);
  if (details && details->changed) return false;
  const bool as_it_was = options.keep_encoding && !options.binary && options.gmsh_version.empty() &&
                         options.cgns_container.empty() && !options.zone_alone;
  if (!format || !details || details->format != format || format->files || !as_it_was) return false;
  if (details->zones.size() > 1 && !format->write_zones) return false;
  if (!std::filesystem::is_regular_file(from)) return false;
  std::ifstream in(from, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) return false;
  if (is_gzip(bytes)) bytes = gunzip(bytes, from.string());
  write_atomically(to, [&](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
  return true;
}

std::vector<std::string> write_mesh_zones(const std::filesystem::path& path,
                                          std::span<const MeshZone> zones,
                                          const WriteOptions& options) {
  const MeshFormat* source = zones.front().details ? zones.front().details->format : nullptr;
  const MeshFormat* format = options.format ? options.format : format_of_output(path, source);
  if (!format) {
    throw UsageError(path.string() + ": unknown file format, expected one of " +
                     writable_extensions());
  }
  if (!format->missing.empty()) {
    throw UsageError(path.string() + ": " + std::string(format->missing));
  }
  if (!options.gmsh_version.empty() && options.gmsh_version != "2.2" &&
      options.gmsh_version != "4.1") {
    throw UsageError("unknown MSH version \"" + options.gmsh_version + "\", expected 2.2 or 4.1");
  }
  if (!options.cgns_container.empty() && options.cgns_container != "hdf5" &&
      options.cgns_container != "adf") {
    throw UsageError("unknown CGNS container \"" + options.cgns_container +
                     "\", expected hdf5 or adf");
  }
  check_dimension(path, *zones.front().mesh->topology, *format);
  const FormatDetails* details = zones.front().details;
  const bool as_source = details != nullptr && details->format == format;
  const bool repaired = std::ranges::any_of(
      zones, [](const MeshZone& zone) { return zone.details != nullptr && zone.details->changed; });
  if (zones.size() > 1 && repaired)
    throw UsageError(path.string() + ": a repaired zone is a new mesh; choose one with --zone N");
  const bool all_zones = format->write_zones && as_source && !options.zone_alone && !repaired;
  if (zones.size() > 1 && !all_zones) {
    throw UsageError(path.string() + ": a " + std::string(format->title) +
                     " file cannot hold several zones; choose one with --zone N");
  }
  WriteOptions encoding = options;
  encoding.binary = options.binary || (options.keep_encoding && as_source && details->binary);
  std::vector<std::string> warnings;
  if (format->files) {
    write_atomically(format->files(path, *zones.front().mesh, details, encoding, warnings));
  } else {
    write_atomically(path, [&](std::ostream& out) {
      warnings = all_zones ? format->write_zones(out, zones, encoding)
                           : format->write(out, *zones.front().mesh, details, encoding);
    });
  }
  if (details != nullptr && details->zones.size() > 1 && !all_zones && !options.zone_alone) {
    warnings.push_back("only zone " + std::to_string(details->zone) + " of " +
                       std::to_string(details->zones.size()) + " is written");
  }
  for (const MeshZone& zone : zones) {
    if (zone.details == nullptr) continue;
    for (std::string& loss : losses(*format, *zone.details)) warnings.push_back(std::move(loss));
  }
  for (std::string& warning : warnings) warning = path.string() + ": " + warning;
  return warnings;
}

}  // namespace winslow::io
