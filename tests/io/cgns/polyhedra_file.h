#pragma once

#include <map>

#include "io/cgns/library_file.h"
#include "io/support/volume_samples.h"

/// CGNS files of volume meshes whose cells are given by their faces.
namespace winslow::test {

/// The faces of all elements of a mesh, each once, and the signed numbers of those of each element.
struct Polyhedra {
  std::vector<Face> faces;
  std::vector<std::vector<cgsize_t>> cells;

  /// ParentElements: the cells that faces point out of, then those that they point into; 0: none.
  CgnsNumbers parents(cgsize_t first_cell) const {
    CgnsNumbers numbers(2 * faces.size(), 0);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      for (const cgsize_t face : cells[c]) {
        const auto place = static_cast<std::size_t>(std::abs(face)) - 1;
        numbers[face > 0 ? place : faces.size() + place] = first_cell + static_cast<cgsize_t>(c);
      }
    }
    return numbers;
  }

  explicit Polyhedra(const MeshData& data) {
    std::map<Face, cgsize_t> numbers;
    for (Index e = 0; e < data.element_count(); ++e) {
      cells.emplace_back();
      for (const Face& face : faces_of(data, e)) {
        const auto [found, added] =
            numbers.emplace(face.sorted(), static_cast<cgsize_t>(faces.size()) + 1);
        if (added) faces.push_back(face);
        cells.back().push_back(added ? found->second : -found->second);
      }
    }
  }
};

/// A section "faces" of all faces.
inline void write_faces(LibraryFile& file, const Polyhedra& all) {
  CgnsNumbers corners, starts{0};
  for (const Face& face : all.faces) {
    for (const Index node : face) corners.push_back(node + 1);
    starts.push_back(static_cast<cgsize_t>(corners.size()));
  }
  file.poly_section("faces", NGON_n, corners, starts);
}

/// A condition at the first face of the first marker. shift: the element before the first face.
inline void write_wall(LibraryFile& file, const MeshData& data, const Polyhedra& all,
                       cgsize_t shift = 0) {
  const Face& wanted = data.markers[0].faces[0];
  for (std::size_t f = 0; f < all.faces.size(); ++f) {
    if (all.faces[f].sorted() != wanted.sorted()) continue;
    file.condition("wall", BCWall, PointList, {static_cast<cgsize_t>(f) + 1 + shift}, FaceCenter);
  }
}

/// cells_first: the cells have the numbers before those of the faces.
inline void write_polyhedra(LibraryFile& file, const MeshData& data, bool cells_first) {
  const Polyhedra all(data);
  const auto faces = static_cast<cgsize_t>(all.faces.size());
  const auto cells = static_cast<cgsize_t>(all.cells.size());
  const cgsize_t shift = cells_first ? cells : 0;
  CgnsNumbers sides, side_starts{0};
  for (const auto& cell : all.cells) {
    for (const cgsize_t face : cell) sides.push_back(face < 0 ? face - shift : face + shift);
    side_starts.push_back(static_cast<cgsize_t>(sides.size()));
  }
  file.next = cells_first ? cells + 1 : 1;
  write_faces(file, all);
  file.next = cells_first ? 1 : faces + 1;
  file.poly_section("polyhedra", NFACE_n, sides, side_starts);
  write_wall(file, data, all, shift);
}

/// A zone without NFACE_n: its faces name the cells on both sides.
inline void write_parents(const std::filesystem::path& path, const MeshData& data,
                          const CgnsNumbers& parents, int container = CG_FILE_HDF5) {
  LibraryFile file(path, container, 3, 3);
  write_places(file, data);
  const Polyhedra all(data);
  write_faces(file, all);
  // libcgns writes the numbers of the sides within their cells, too: a second half.
  CgnsNumbers values = parents;
  values.resize(2 * parents.size(), 0);
  require_cgns(cg_parent_data_write(file.file, file.base, file.zone, 1, values.data()));
  write_wall(file, data, all);
}

}  // namespace winslow::test
