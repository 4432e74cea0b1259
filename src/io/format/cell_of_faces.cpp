#include "io/format/cell_of_faces.h"

namespace winslow::io {
namespace {

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
bool same_faces(const CellOfFaces& cell, std::span<const Face> faces) {
  std::vector<Face> own, given;
  for (const Face& face : shape_of(cell.type).faces)
    own.push_back(by_nodes(face, cell.corners).sorted());
  for (const Face& face : faces) given.push_back(face.sorted());
  std::ranges::sort(own);
  std::ranges::sort(given);
  return own == given;
}

}  // namespace

std::optional<CellOfFaces> cell_of_faces(std::span<const Face> faces) {
  const auto type = type_of(faces);
  if (!type) return std::nullopt;
  const bool on_triangle = *type == ElementType::tetrahedron || *type == ElementType::prism;
  const std::size_t base_size = on_triangle ? 3 : 4;
  const Face& base =
      *std::ranges::find_if(faces, [&](const Face& face) { return face.size() == base_size; });
  // Corners 0 1 2 (3) of an element are clockwise seen from outside its base.
  CellOfFaces cell{*type, {}};
  for (const Index node : base.reversed()) cell.corners.push_back(node);
  const bool pointed = *type == ElementType::tetrahedron || *type == ElementType::pyramid;
  const std::size_t upper = pointed ? 1 : base_size;
  for (std::size_t k = 0; k < upper; ++k)
    cell.corners.push_back(above(cell.corners[k], base, faces));
  if (std::ranges::find(cell.corners, -1) != cell.corners.end()) return std::nullopt;
  if (!same_faces(cell, faces)) return std::nullopt;
  return cell;
}

void add_cell_of_faces(std::span<const Face> faces, MeshData& data) {
  if (std::ranges::all_of(faces, [](const Face& face) { return face.size() <= 4; })) {
    if (const auto cell = cell_of_faces(faces)) return data.add_element(cell->type, cell->corners);
  }
  data.add_polyhedron(faces);
}

}  // namespace winslow::io
