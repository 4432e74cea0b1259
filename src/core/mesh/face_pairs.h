#pragma once

#include "core/mesh/mesh_data.h"

namespace winslow {

/// The directions in which two elements have the face between them: opposite ones if they are
/// oriented alike; the same one; or, of a quadrilateral, twisted: its corners in another order.
enum class Facing : std::uint8_t { opposite, same, twisted };

/// The faces of a mesh, each once, and their sides. A side is a face as seen from one of its
/// elements; sides are numbered element by element.
struct FacePairs {
  std::vector<Index> side_offsets;             ///< #elements + 1
  std::vector<Index> face_of_side;             ///< #sides
  std::vector<Index> first_side;               ///< #faces: the lower of its sides
  std::vector<std::array<Index, 2>> elements;  ///< #faces: that of the first side, the other or -1
  std::vector<Facing> facing;                  ///< #faces; opposite on the boundary

  Index face_count() const { return static_cast<Index>(elements.size()); }
  /// The faces of an element, in the order of its sides.
  std::span<const Index> faces_of(Index element) const {
    const std::size_t begin = at(side_offsets[at(element)]);
    return std::span(face_of_side).subspan(begin, at(side_offsets[at(element) + 1]) - begin);
  }
};

/// Pairs the sides of all elements that have the same nodes. Faces are numbered in the order of
/// their nodes (Face::sorted). Throws MeshError naming the third element at a face, UsageError for
/// more sides than an Index can number.
FacePairs pair_faces(const MeshData& data);

/// The nodes of a side, in the direction that the element has them.
Face face_of_side(const MeshData& data, Index element, Index side_of_element);
/// The nodes of a face, as its first side has them.
Face first_face(const MeshData& data, const FacePairs& pairs, Index face);

/// Which elements have to be turned inside out for all to be oriented alike (#elements).
///
/// Two elements that share a face must have it in opposite directions. So the orientation of one
/// element decides that of its neighbours and of the whole connected part, in tangled meshes, too.
/// The sign of the part: plane and volume elements get a positive total area or volume, which
/// depends on the boundary alone; surface elements are oriented as the first of their part.
///
/// Throws MeshError: an orientation that cannot be made consistent; neighbours that join the
/// corners of a shared quadrilateral in different orders; a plane or volume mesh without boundary.
std::vector<bool> elements_to_turn(const MeshData& data, const FacePairs& pairs);

/// The corners of all elements (as MeshData::element_nodes) with some elements turned.
std::vector<Index> turned_elements(const MeshData& data, const std::vector<bool>& turn);

}  // namespace winslow
