#include "io/openfoam/cells.h"

#include "core/mesh/element_type.h"

namespace winslow::io::openfoam {
namespace {

struct Cell {
  ElementType type;
  std::vector<Index> corners;
};

std::optional<ElementType> type_of(std::span<const Face> faces) {
  const auto triangles =
      std::ranges::count_if(faces, [](const Face& face) { return face.size() == 3; });
  const auto others = static_cast<std::ptrdiff_t>(faces.size()) - triangles;
  if (triangles == 4 && others == 0) return ElementType::tetrahedron;
  if (triangles == 4 && others == 1) return ElementType::pyramid;
  if (triangles == 2 && others == 3) return ElementType::prism;
  if (triangles == 0 && others == 6) return ElementType::hexahedron;
  return std::nullopt;
}

bool has(const Face& face, Index node) {
  return std::find(face.begin(), face.end(), node) != face.end();
}

/// The neighbour of `corner` in one of the faces that is not in the base; -1: there is none.
Index above(Index corner, const Face& base, std::span<const Face> faces) {
  for (const Face& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      if (face[k] != corner) continue;
      for (const std::size_t step : {std::size_t{1}, face.size() - 1}) {
        const Index next = face[(k + step) % face.size()];
        if (!has(base, next)) return next;
      }
    }
  }
  return -1;
}

/// True if the faces of the element are these.
bool same_faces(const Cell& cell, std::span<const Face> faces) {
  std::vector<std::array<Index, 4>> own, given;
  for (const Face& face : shape_of(cell.type).faces)
    own.push_back(by_nodes(face, cell.corners).sorted());
  for (const Face& face : faces) given.push_back(face.sorted());
  std::ranges::sort(own);
  std::ranges::sort(given);
  return own == given;
}

/// Builds the element with these faces, which are counter-clockwise seen from outside. Returns
/// nothing if it is no tetrahedron, pyramid, prism or hexahedron. Corner 0 is the first node of the
/// first triangle (pyramid: of the quadrilateral; hexahedron: of the first face).
std::optional<Cell> build_cell(std::span<const Face> faces) {
  const auto type = type_of(faces);
  if (!type) return std::nullopt;
  const bool on_triangle = *type == ElementType::tetrahedron || *type == ElementType::prism;
  const std::size_t base_size = on_triangle ? 3 : 4;
  const Face& base =
      *std::ranges::find_if(faces, [&](const Face& face) { return face.size() == base_size; });
  // Corners 0 1 2 (3) of an element are clockwise seen from outside its base.
  Cell cell{*type, {}};
  for (const Index node : base.reversed()) cell.corners.push_back(node);
  const bool pointed = *type == ElementType::tetrahedron || *type == ElementType::pyramid;
  const std::size_t upper = pointed ? 1 : base_size;
  for (std::size_t k = 0; k < upper; ++k)
    cell.corners.push_back(above(cell.corners[k], base, faces));
  if (std::ranges::find(cell.corners, -1) != cell.corners.end()) return std::nullopt;
  if (!same_faces(cell, faces)) return std::nullopt;
  return cell;
}

}  // namespace

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
  const auto built = build_cell(faces);
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
