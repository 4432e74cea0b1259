#include "io/openfoam/cells.h"

#include "io/format/cell_of_faces.h"

namespace winslow::io::openfoam {

std::size_t place_of_cell(const PolyMesh& mesh, const std::vector<Index>& faces) {
  const Index first = faces.front() < 0 ? ~faces.front() : faces.front();
  return mesh.faces.places[at(first)];
}

namespace {

[[noreturn]] void refuse(const Source& source, std::size_t place, Index cell,
                         const std::string& shape) {
  source.fail(place, "cell " + std::to_string(cell) + ", a polyhedron " + shape,
              "tetrahedra, pyramids, prisms and hexahedra");
}

void add_cell(const Source& source, const PolyMesh& mesh, Index cell,
              const std::vector<Index>& coded, ParsedMesh& out) {
  std::vector<Face> faces;
  const std::size_t place = place_of_cell(mesh, coded);
  for (const Index f : coded) {
    const Index face = f < 0 ? ~f : f;
    const auto points = mesh.faces[face];
    if (points.size() != 3 && points.size() != 4)
      refuse(source, mesh.faces.places[at(face)], cell,
             "with a face of " + std::to_string(points.size()) + " points");
    faces.push_back(f < 0 ? Face(points).reversed() : Face(points));
  }
  const auto built = cell_of_faces(faces);
  if (!built) refuse(source, place, cell, "of " + std::to_string(faces.size()) + " faces");
  out.data.add_element(built->type, built->corners);
  out.where.elements.push_back(place);
}

}  // namespace

void add_cells(const Source& source, const PolyMesh& mesh, ParsedMesh& out) {
  const auto faces_of = mesh.faces_of_cells();
  for (Index c = 0; c < mesh.cells; ++c) {
    if (faces_of[at(c)].empty())
      source.fail(mesh.owner_place, "no face of cell " + std::to_string(c), "four or more");
    add_cell(source, mesh, c, faces_of[at(c)], out);
  }
}

}  // namespace winslow::io::openfoam
