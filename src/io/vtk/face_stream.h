#pragma once

#include <pugixml.hpp>

#include "core/mesh/element_type.h"
#include "io/vtk/grid.h"
#include "io/vtk/vtu_arrays.h"

/// Face streams, by which VTK files say what the faces of a polyhedron (cell type 42) are: the
/// number of faces, then for each face the number of its nodes and the nodes.
///
///     std::vector<std::int64_t> stream;
///     append_face_stream(faces, stream);
///     for_each_face(std::span<const std::int64_t>(stream), [&](auto nodes) { ... });
namespace winslow::io::vtk {

/// Calls visit(nodes) for each face of a stream. Returns false if the stream ends early, or goes on
/// behind its last face.
template <class Number, class Visit>
bool for_each_face(std::span<const Number> stream, const Visit& visit) {
  if (stream.empty() || stream[0] < 0) return false;
  auto left = static_cast<std::uint64_t>(stream[0]);
  std::size_t k = 1;
  for (; left > 0 && k < stream.size(); --left) {
    const Number nodes = stream[k++];
    if (nodes < 0 || static_cast<std::uint64_t>(nodes) > stream.size() - k) return false;
    visit(stream.subspan(k, static_cast<std::size_t>(nodes)));
    k += static_cast<std::size_t>(nodes);
  }
  return left == 0 && k == stream.size();
}
template <class Number, class Visit>
bool for_each_face(std::span<Number> stream, const Visit& visit) {
  return for_each_face(std::span<const Number>(stream), visit);
}

void append_face_stream(std::span<const Face> faces, std::vector<std::int64_t>& stream);

/// Throws InputError for a stream of `size` numbers that is none.
[[noreturn]] void refuse_face_stream(const Source& source, std::size_t place, std::size_t cell,
                                     std::size_t size);

/// Reads the faces of polyhedra from the arrays of <Cells>: "faces" and "faceoffsets", or the four
/// of VTK 9.4 (file version 2.3), in which several cells can share a face: "face_connectivity" and
/// "face_offsets" (the end of each face), "polyhedron_to_faces" and "polyhedron_offsets" (the end
/// of each cell, polyhedron or not). The grid must have its other cells. Throws InputError.
void read_faces(const Source& source, const VtuArrays& arrays, const pugi::xml_node& cells,
                Grid& grid);

}  // namespace winslow::io::vtk
