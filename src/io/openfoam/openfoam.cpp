#include "io/openfoam/openfoam.h"

#include <set>
#include <system_error>
#include <tuple>

#include "core/error.h"
#include "core/types.h"
#include "io/text/numbers.h"

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
  // A .foam file is empty, so the missing item can only be the folder that it stands for.
  return is_folder ? fs::path() : start / "constant" / "polyMesh";
}

}  // namespace

const MeshFormat format{.name = "foam",
                        .title = "OpenFOAM",
                        .versions = "the folder polyMesh",
                        .markers = "yes, by name (patches)",
                        .regions = "yes, cell zones are read",
                        .quadrilaterals = "no plane meshes",
                        .folder_name = "polyMesh",
                        .writes = {false, false, true},
                        .recognise = [](const Content&) { return Evidence{}; },
                        .read = read,
                        .find_folder = find_folder,
                        .files = files};

namespace {

struct Patch {
  std::string name;
  std::vector<Face> faces;
};

/// Faces in OpenFOAM's order: first inner faces, sorted by the lower and then by the higher cell
/// number ("upper triangular"), then those of each patch. Faces are counter-clockwise seen from
/// outside the owner.
struct FaceList {
  std::vector<Face> faces;
  std::vector<Index> owner, neighbour;
};

void add_inner_faces(const Topology& topology, FaceList& list) {
  struct Inner {
    Index owner, neighbour;
    Face nodes;
  };
  std::vector<Inner> inner;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [nodes, elements] = topology.face(f);
    if (elements[1] < 0) continue;
    if (elements[0] < elements[1]) {
      inner.push_back({elements[0], elements[1], nodes});
    } else {
      inner.push_back({elements[1], elements[0], nodes.reversed()});
    }
  }
  std::ranges::sort(inner, [](const Inner& a, const Inner& b) {
    return std::tie(a.owner, a.neighbour) < std::tie(b.owner, b.neighbour);
  });
  for (const Inner& face : inner) {
    list.faces.push_back(face.nodes);
    list.owner.push_back(face.owner);
    list.neighbour.push_back(face.neighbour);
  }
}

/// True if both faces have the same orientation.
bool same_direction(const Face& a, const Face& b) {
  const auto second = [](const Face& face, Index first) {
    std::size_t k = 0;
    while (k < face.size() && face[k] != first) ++k;
    return face[(k + 1) % face.size()];
  };
  return second(a, a[0]) == second(b, a[0]);
}

/// Boundary faces by patches: for each marker its faces that no earlier marker has, then the faces
/// without a marker.
std::vector<Patch> patches_of(const Topology& topology, std::vector<std::string>& warnings) {
  std::vector<Patch> patches;
  std::vector<bool> taken(at(topology.face_count()), false);
  std::size_t inside = 0, twice = 0;
  if (topology.markers().from_file()) {
    for (const Marker& marker : topology.markers()) {
      Patch patch{marker.name, {}};
      for (const Face& face : marker.faces) {
        const auto f = *topology.find_face(face);
        const auto [nodes, elements] = topology.face(f);
        inside += elements[1] >= 0 ? 1 : 0;
        twice += elements[1] < 0 && taken[at(f)] ? 1 : 0;
        if (elements[1] >= 0 || taken[at(f)]) continue;
        taken[at(f)] = true;
        patch.faces.push_back(same_direction(face, nodes) ? face : face.reversed());
      }
      patches.push_back(std::move(patch));
    }
  }
  Patch rest{"defaultFaces", {}};
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [nodes, elements] = topology.face(f);
    if (elements[1] < 0 && !taken[at(f)]) rest.faces.push_back(nodes);
  }
  if (!rest.faces.empty()) {
    warnings.push_back(std::to_string(rest.faces.size()) +
                       " boundary faces in no marker are written as the patch defaultFaces");
    patches.push_back(std::move(rest));
  }
  if (inside > 0) {
    warnings.push_back(std::to_string(inside) +
                       " faces of markers lie between two cells: patches cannot hold them");
  }
  if (twice > 0)
    warnings.push_back(std::to_string(twice) + " faces in a second marker are in the first only");
  return patches;
}

/// Replaces blanks and punctuation in names, which would end a word of OpenFOAM.
void make_names_safe(std::vector<Patch>& patches, std::vector<std::string>& warnings) {
  std::set<std::string> taken;
  for (Patch& patch : patches) {
    std::string name = patch.name.empty() ? "unnamed" : as_word(patch.name, "\"'/;{}()[]$");
    while (!taken.insert(name).second) name += '_';
    if (name != patch.name) {
      warnings.push_back("marker \"" + patch.name + "\" is written as \"" + name +
                         "\": OpenFOAM allows no such name");
    }
    patch.name = name;
  }
}

std::string header(const char* type, const char* object) {
  return std::string(
             "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       ") +
         type + ";\n    location    \"constant/polyMesh\";\n    object      " + object + ";\n}\n\n";
}

void write_points(std::ostream& stream, const Mesh& mesh, const std::string& head,
                  const std::string& end) {
  TextWriter out(stream);
  out << head << mesh.coordinates.size() << "\n(\n";
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    const Vec3 p = mesh.coordinates.xyz(i);
    out << '(' << p.x() << ' ' << p.y() << ' ' << p.z() << ")\n";
  }
  out << ')' << end;
}

void write_faces(std::ostream& stream, const std::vector<Face>& faces) {
  TextWriter out(stream);
  out << header("faceList", "faces") << faces.size() << "\n(\n";
  for (const Face& face : faces) {
    out << face.size() << '(';
    for (std::size_t k = 0; k < face.size(); ++k) out << (k > 0 ? " " : "") << face[k];
    out << ")\n";
  }
  out << ")\n";
}

void write_labels(std::ostream& stream, const char* object, const std::vector<Index>& labels) {
  TextWriter out(stream);
  out << header("labelList", object) << labels.size() << "\n(\n";
  for (const Index label : labels) out << label << '\n';
  out << ")\n";
}

void write_boundary(std::ostream& stream, const std::vector<Patch>& patches, std::size_t first) {
  TextWriter out(stream);
  out << header("polyBoundaryMesh", "boundary") << patches.size() << "\n(\n";
  for (const Patch& patch : patches) {
    out << "    " << patch.name
        << "\n    {\n        type            patch;\n        nFaces          " << patch.faces.size()
        << ";\n        startFace       " << first << ";\n    }\n";
    first += patch.faces.size();
  }
  out << ")\n";
}

/// The folder of an output path; made if it does not exist.
fs::path make_folder(const fs::path& path) {
  const fs::path plain = path.has_filename() ? path : path.parent_path();
  fs::path folder =
      plain.extension() == ".foam" ? plain.parent_path() / "constant" / "polyMesh" : plain;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": cannot be made: " + error.message());
  return folder;
}

using Write = std::function<void(std::ostream&)>;

std::vector<Write> texts_of(const Details& details, const Mesh& mesh) {
  std::vector<Write> writes{
      [&](std::ostream& out) { write_points(out, mesh, details.texts[0], details.points_end); }};
  for (std::size_t k = 1; k < file_names.size(); ++k)
    writes.emplace_back([&details, k](std::ostream& out) { out << details.texts[k]; });
  return writes;
}

std::vector<Write> new_texts(const Mesh& mesh, std::vector<std::string>& warnings) {
  auto list = std::make_shared<FaceList>();
  add_inner_faces(*mesh.topology, *list);
  auto patches = std::make_shared<std::vector<Patch>>(patches_of(*mesh.topology, warnings));
  make_names_safe(*patches, warnings);
  const std::size_t inner = list->faces.size();
  for (const Patch& patch : *patches) {
    for (const Face& face : patch.faces) {
      list->faces.push_back(face);
      list->owner.push_back(mesh.topology->face(*mesh.topology->find_face(face)).elements[0]);
    }
  }
  if (!mesh.topology->regions().empty())
    warnings.emplace_back("cell zones are not written: the names of element sets are lost");
  return {[&mesh](std::ostream& out) {
            write_points(out, mesh, header("vectorField", "points"), "\n");
          },
          [list](std::ostream& out) { write_faces(out, list->faces); },
          [list](std::ostream& out) { write_labels(out, "owner", list->owner); },
          [list](std::ostream& out) { write_labels(out, "neighbour", list->neighbour); },
          [patches, inner](std::ostream& out) { write_boundary(out, *patches, inner); }};
}

}  // namespace

std::vector<OutputFile> files(const fs::path& path, const Mesh& mesh, const FormatDetails* source,
                              const WriteOptions&, std::vector<std::string>& warnings) {
  const auto* own = dynamic_cast<const Details*>(source);
  const bool kept = own != nullptr && own->fits(mesh);
  const std::vector<Write> writes = kept ? texts_of(*own, mesh) : new_texts(mesh, warnings);
  const fs::path folder = make_folder(path);
  const bool compressed = own != nullptr && own->compressed;
  std::vector<OutputFile> files;
  for (std::size_t k = 0; k < writes.size(); ++k) {
    const fs::path plain = folder / file_names[k];
    const fs::path packed = folder / (std::string(file_names[k]) + ".gz");
    // Remove the other variant, which OpenFOAM or winslow might read instead.
    files.push_back({compressed ? packed : plain, writes[k], compressed ? plain : packed});
  }
  if (path.extension() == ".foam") files.push_back({path, [](std::ostream&) {}, {}});
  return files;
}

}  // namespace winslow::io::openfoam
