#include "io/openfoam/cells.h"

#include "core/parallel/parallel_for.h"
#include "core/quality/volume_element.h"
#include "io/format/cell_of_faces.h"
#include "io/openfoam/foam_file.h"

namespace winslow::io::openfoam {
namespace {

/// Where the first face of a cell is in the source.
std::size_t place_of_cell(const PolyMesh& mesh, const std::vector<Index>& faces) {
  const Index first = faces.front() < 0 ? ~faces.front() : faces.front();
  return mesh.faces.places[at(first)];
}

void add_cell(const PolyMesh& mesh, const std::vector<Index>& coded, ParsedMesh& out) {
  std::vector<Face> faces;
  for (const Index f : coded) {
    const Face face(mesh.faces[f < 0 ? ~f : f]);
    faces.push_back(f < 0 ? face.reversed() : face);
  }
  add_cell_of_faces(faces, out.data);
  out.where.elements.push_back(place_of_cell(mesh, coded));
}

}  // namespace

void add_cells(const Source& source, const PolyMesh& mesh, ParsedMesh& out) {
  const auto faces_of = mesh.faces_of_cells();
  for (Index c = 0; c < mesh.cells; ++c) {
    if (faces_of[at(c)].empty())
      source.fail(mesh.owner_place, "no face of cell " + std::to_string(c), "four or more");
    add_cell(mesh, faces_of[at(c)], out);
  }
}

namespace {

/// Whether a cell is inverted, or flat at a corner, as the element that it is, and sound as one of
/// finite volumes.
bool is_sound_by_faces(const MeshData& data, Index e) {
  const auto corners = data.element(e);
  const SpacePoints x(data.coordinates);
  const ElementShape& shape = shape_of(data.types[at(e)]);
  std::vector<Vec3> places;
  for (const Index node : corners) places.emplace_back(x[node]);
  if (!has_flat_corner(shape, places) && has_positive_jacobian(x, shape, corners)) return false;
  const PolyhedronShape by_faces(shape.faces, places);
  return has_positive_jacobian(x, by_faces.shape(), corners);
}

}  // namespace

Index give_faces_to_flat_cells(MeshData& data) {
  std::vector<unsigned char> by_faces(at(data.element_count()), 0);
  parallel_for(0, data.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e)
      if (data.types[at(e)] != ElementType::polyhedron)
        by_faces[at(e)] = is_sound_by_faces(data, e) ? 1 : 0;
  });
  const auto found = static_cast<Index>(std::ranges::count(by_faces, 1));
  if (found == 0) return 0;
  MeshData out = std::move(data);
  std::vector<ElementType> types = std::exchange(out.types, {});
  const std::vector<Index> nodes = std::exchange(out.element_nodes, {});
  const std::vector<Index> offsets = std::exchange(out.element_offsets, {0});
  const std::vector<Face> faces = std::exchange(out.faces, {});
  const std::vector<Index> face_offsets = std::exchange(out.face_offsets, {});
  const auto row = [](const auto& values, const std::vector<Index>& begin, std::size_t k) {
    return std::span(values).subspan(at(begin[k]), at(begin[k + 1] - begin[k]));
  };
  std::vector<Face> own;
  for (std::size_t e = 0; e < types.size(); ++e) {
    const auto corners = row(nodes, offsets, e);
    if (types[e] == ElementType::polyhedron) {
      out.add_polyhedron(corners, row(faces, face_offsets, e));
    } else if (by_faces[e] == 0) {
      out.add_element(types[e], corners);
    } else {
      own.clear();
      for (const Face& face : shape_of(types[e]).faces) own.push_back(by_nodes(face, corners));
      out.add_polyhedron(corners, own);
    }
  }
  data = std::move(out);
  return found;
}

namespace {

class ZoneReader {
 public:
  ZoneReader(Source& source, const std::filesystem::path& file, ParsedMesh& mesh)
      : source_(source), scan_(source, source.append(file)), mesh_(mesh) {}

  void read() {
    form_ = scan_.header();
    const Index zones = scan_.count({"the number of zones"}, 1);
    if (zones == 0) return;
    scan_.expect("(");
    auto& of = mesh_.data.element_region;
    of.assign(at(mesh_.data.element_count()), -1);
    for (Index k = 0; k < zones; ++k) read_zone();
    scan_.expect(")");
    if (mesh_.data.regions.empty()) of.clear();
    if (twice_ > 0)
      mesh_.warnings.push_back(std::to_string(twice_) + (twice_ == 1 ? " cell is" : " cells are") +
                               " in several cell zones: the first counts");
  }

 private:
  void read_zone() {
    const auto name = scan_.next();
    if (name.empty() || name == ")") scan_.fail(name, "the name of a cell zone");
    const std::string zone(name);
    scan_.expect("{");
    for (auto key = scan_.next(); key != "}"; key = scan_.next()) {
      if (key.empty()) scan_.fail(key, "'}' at the end of zone " + in_quotes(zone));
      if (key == "cellLabels") {
        read_cells(zone);
        continue;
      }
      for (auto word = scan_.next(); word != ";"; word = scan_.next())
        if (word.empty()) scan_.fail(word, "';'");
    }
  }

  void read_cells(const std::string& zone) {
    if (scan_.peek().starts_with("List<")) scan_.next();
    const FoamList<Index> cells = scan_.labels(form_, {"a cell"});
    scan_.expect(";");
    if (cells.values.empty()) return;
    MeshData& data = mesh_.data;
    const auto region = static_cast<Index>(data.regions.size());
    data.regions.push_back({zone, region + 1});
    for (std::size_t k = 0; k < cells.values.size(); ++k) {
      const Index cell = cells.values[k];
      if (cell >= data.element_count())
        source_.fail(cells.places[k],
                     "cell " + std::to_string(cell) + " in zone " + in_quotes(zone),
                     "0 to " + std::to_string(data.element_count() - 1));
      Index& of = data.element_region[at(cell)];
      if (of < 0)
        of = region;
      else
        twice_ += of == region ? 0 : 1;
    }
  }

  Source& source_;
  FoamScanner scan_;
  ParsedMesh& mesh_;
  FoamForm form_;
  Index twice_ = 0;  // cells of a zone that another zone has, too
};

}  // namespace

void read_cell_zones(Source& source, const MeshPlace& place, ParsedMesh& mesh) {
  const std::filesystem::path file = find_file(place, "cellZones");
  if (!file.empty()) ZoneReader(source, file, mesh).read();
}

}  // namespace winslow::io::openfoam
