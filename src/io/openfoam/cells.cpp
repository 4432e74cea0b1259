#include "io/openfoam/cells.h"

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
