#include "io/openfoam/openfoam.h"

#include <system_error>

#include "core/error.h"
#include "io/format/periodicity.h"
#include "io/openfoam/new_mesh.h"
#include "io/text/numbers.h"

namespace winslow::io::openfoam {
namespace {

namespace fs = std::filesystem;

fs::path find_folder(const fs::path& path, const std::string& time) {
  const auto place = place_to_read(path, time);
  return place ? place->folder() : fs::path();
}

fs::path folder_to_write(const fs::path& path, const fs::path& input) {
  const auto source = input.empty() ? std::nullopt : place_to_read(input, {});
  return place_to_write(path, source ? &*source : nullptr).folder();
}

}  // namespace

const MeshFormat format{.name = "foam",
                        .title = "OpenFOAM",
                        .versions = "the folder polyMesh",
                        .encodings = "text, binary (kept)",
                        .markers = "yes, by name (patches)",
                        .regions = "yes, cell zones are read",
                        .quadrilaterals = "yes, one cell thick",
                        .folder_name = "polyMesh",
                        .writes = {true, false, true},
                        .polyhedra = true,
                        .polygons = true,
                        .keeps_periodic = true,
                        .recognise = [](const Content&) { return Evidence{}; },
                        .find_folder = find_folder,
                        .read_folder = read,
                        .is_folder_to_write = is_folder_to_write,
                        .folder_to_write = folder_to_write,
                        .files = files};

namespace {

using Write = std::function<void(std::ostream&)>;

/// Where a mesh says that its files are: "0.5/polyMesh".
std::string location_of(const MeshPlace& place) {
  if (place.instance.empty()) return "polyMesh";
  return place.instance + (place.region.empty() ? "" : "/" + place.region) + "/polyMesh";
}

std::string header(const char* type, const char* object, const MeshPlace& place) {
  return std::string(
             "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       ") +
         type + ";\n    location    \"" + location_of(place) + "\";\n    object      " + object +
         ";\n}\n\n";
}

void write_new_points(std::ostream& stream, const NewMesh& mesh, const MeshPlace& place) {
  TextWriter out(stream);
  out << header("vectorField", "points", place);
  write_points(out, mesh.xyz, {});
  out << '\n';
}

void write_faces(std::ostream& stream, const NewMesh& mesh, const MeshPlace& place) {
  TextWriter out(stream);
  out << header("faceList", "faces", place) << mesh.faces.size() << "\n(\n";
  for (const Face& face : mesh.faces) {
    out << face.size() << '(';
    for (std::size_t k = 0; k < face.size(); ++k) out << (k > 0 ? " " : "") << face[k];
    out << ")\n";
  }
  out << ")\n";
}

void write_labels(std::ostream& stream, const char* object, const std::vector<Index>& labels,
                  const MeshPlace& place) {
  TextWriter out(stream);
  out << header("labelList", object, place) << labels.size() << "\n(\n";
  for (const Index label : labels) out << label << '\n';
  out << ")\n";
}

void write_boundary(std::ostream& stream, const NewMesh& mesh, const MeshPlace& place) {
  TextWriter out(stream);
  std::size_t first = mesh.neighbour.size();
  out << header("polyBoundaryMesh", "boundary", place) << mesh.patches.size() << "\n(\n";
  for (const NewPatch& patch : mesh.patches) {
    const std::string count = std::to_string(patch.faces.size()), start = std::to_string(first);
    std::string entry =
        patch.entry.empty() ? "\n        type            patch;\n    " : patch.entry;
    if (entry.find("nFaces") == std::string::npos)
      entry += "    nFaces          0;\n        startFace       0;\n    ";
    entry = with_entry(with_entry(entry, "nFaces", count), "startFace", start);
    out << "    " << patch.name << "\n    {" << entry << "}\n";
    first += patch.faces.size();
  }
  out << ")\n";
}

/// Makes the folder if it does not exist.
void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": cannot be made: " + error.message());
}

/// A file of a mesh to write, in place of its other variant (compressed or not), which OpenFOAM or
/// winslow might read instead.
OutputFile output_file(const fs::path& folder, const std::string& name, bool compressed,
                       Write write) {
  const fs::path plain = folder / name, packed = folder / (name + ".gz");
  return {compressed ? packed : plain, std::move(write), {compressed ? plain : packed}};
}

/// Zones and the like in a folder, which are numbers of faces, cells and points: they fit no other
/// mesh.
std::vector<fs::path> files_beside(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const char* name : {"cellZones", "faceZones", "pointZones", "pointLevel", "cellLevel",
                           "level0Edge", "surfaceIndex", "refinementHistory"})
    for (const char* end : {"", ".gz"})
      if (fs::path file = folder / (std::string(name) + end); fs::exists(file, error))
        found.push_back(std::move(file));
  return found;
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return !a.empty() && fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

std::vector<double> points_of(const Details& details, const Mesh& mesh) {
  if (details.thin) return details.thin->points(mesh.coordinates);
  const auto values = mesh.coordinates.values();
  return {values.begin(), values.end()};
}

/// The points of a mesh whose nodes have moved.
OutputFile moved_points(const Details& own, const Mesh& mesh, const MeshPlace& place,
                        const WriteOptions& options) {
  FoamForm form = own.mesh.points_form;
  std::string head = own.mesh.points_head;
  if (!place.instance.empty() && place.instance != own.place.instance)
    head = with_entry(head, "location", '"' + location_of(place) + '"');
  if (form.binary && !options.binary) {
    form.binary = false;
    head = with_entry(head, "format", "ascii");
  }
  return output_file(place.folder(), file_names[0], own.mesh.points_compressed,
                     [&own, &mesh, form, head](std::ostream& stream) {
                       TextWriter out(stream);
                       out << head;
                       write_points(out, points_of(own, mesh), form);
                       out << own.mesh.points_end;
                     });
}

/// The files of a mesh whose nodes have moved: the points alone where OpenFOAM finds all others,
/// else all.
std::vector<OutputFile> moved_files(const Details& own, const Mesh& mesh, const MeshPlace& place,
                                    const WriteOptions& options) {
  const fs::path folder = place.folder();
  std::vector<OutputFile> files{moved_points(own, mesh, place, options)};
  const auto& kept = own.mesh.kept;
  const bool found = std::ranges::all_of(kept.begin(), kept.begin() + 4, [&](const KeptFile& file) {
    return same_file(find_file(place, file.name), file.path);
  });
  if (found) return files;
  bool sets = false;
  for (const KeptFile& file : kept) {
    sets = sets || file.name.starts_with("sets/");
    files.push_back(output_file(folder, file.name, file.compressed,
                                [&file](std::ostream& out) { out << file.text; }));
  }
  if (sets) make_folder(folder / "sets");
  for (fs::path& stale : files_beside(folder)) {
    const bool written = std::ranges::any_of(
        files, [&](const OutputFile& file) { return same_file(file.path, stale); });
    if (!written) files.front().replaces.push_back(std::move(stale));
  }
  return files;
}

std::vector<OutputFile> new_files(const NewMesh& made, const MeshPlace& place, bool compressed) {
  const auto mesh = std::make_shared<const NewMesh>(made);
  const fs::path folder = place.folder();
  const std::array<Write, 5> writes{
      [mesh, place](std::ostream& out) { write_new_points(out, *mesh, place); },
      [mesh, place](std::ostream& out) { write_faces(out, *mesh, place); },
      [mesh, place](std::ostream& out) { write_labels(out, "owner", mesh->owner, place); },
      [mesh, place](std::ostream& out) { write_labels(out, "neighbour", mesh->neighbour, place); },
      [mesh, place](std::ostream& out) { write_boundary(out, *mesh, place); }};
  std::vector<OutputFile> files;
  for (std::size_t k = 0; k < writes.size(); ++k)
    files.push_back(output_file(folder, file_names[k], compressed, writes[k]));
  for (fs::path& stale : files_beside(folder)) files.front().replaces.push_back(std::move(stale));
  return files;
}

void warn_of_losses(const Mesh& mesh, const Details* own, std::vector<std::string>& warnings) {
  if (!mesh.topology->regions().empty())
    warnings.emplace_back("cell zones are not written: the names of element sets are lost");
  if (own == nullptr) return;
  if (own->mesh.kept.size() > 4)
    warnings.push_back(list_of(std::span(own->mesh.kept).subspan(4),
                               [](const KeptFile& file) { return file.name; }) +
                       " of the source do not fit the new cells and are not written");
  if (own->roles.pairs_move)
    warnings.emplace_back(
        "the faces of cyclic patches are new: createPatch -overwrite puts them in order");
}

}  // namespace

std::vector<OutputFile> files(const fs::path& path, const Mesh& mesh, const FormatDetails* source,
                              const WriteOptions& options, std::vector<std::string>& warnings) {
  const auto* own = dynamic_cast<const Details*>(source);
  const MeshPlace place = place_to_write(path, own ? &own->place : nullptr);
  make_folder(place.folder());
  if (own != nullptr && own->fits(mesh)) {
    for (std::string& text : stale_pairs(*own, mesh)) warnings.push_back(std::move(text));
    return moved_files(*own, mesh, place, options);
  }
  const bool plane = mesh.topology->kind() == MeshKind::plane;
  const NewMesh made = plane ? new_thin_mesh(mesh, source, own) : new_volume_mesh(mesh, own);
  warnings.insert(warnings.end(), made.warnings.begin(), made.warnings.end());
  warn_of_losses(mesh, own, warnings);
  if (own == nullptr && source != nullptr && source->periodic)
    if (const std::string names = named_pairs(*source->periodic); !names.empty())
      warnings.push_back("the periodic pairs of the source (" + names + ") are not written");
  return new_files(made, place, own != nullptr && own->mesh.points_compressed);
}

}  // namespace winslow::io::openfoam
