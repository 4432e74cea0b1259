#pragma once

#include "core/mesh/mesh_data.h"

namespace winslow {

/// How two elements see the face between them: in opposite directions, as elements do that are
/// oriented alike; in the same one; or, a quadrilateral, with its corners in another order.
enum class Facing : std::uint8_t { opposite, same, twisted };

/// The faces of a mesh, each once, and which sides of elements they are. A side is a face as one
/// element has it; sides are counted element by element.
struct FacePairs {
  std::vector<Index> side_offsets;             ///< #elements + 1
  std::vector<Index> face_of_side;             ///< #sides
  std::vector<Index> first_side;               ///< #faces: the side that comes first
  std::vector<std::array<Index, 2>> elements;  ///< #faces: that of the first side, the other or -1
  std::vector<Facing> facing;                  ///< #faces: of the elements; opposite if one is -1

  Index face_count() const { return static_cast<Index>(elements.size()); }
  /// Sides of an element, as entries of face_of_side.
  std::span<const Index> faces_of(Index element) const {
    const auto b = static_cast<std::size_t>(side_offsets[static_cast<std::size_t>(element)]);
    const auto e = static_cast<std::size_t>(side_offsets[static_cast<std::size_t>(element) + 1]);
    return std::span(face_of_side).subspan(b, e - b);
  }
};

/// Pairs the sides of all elements that have the same nodes. Faces are numbered in the order of
/// their nodes (Face::sorted). Throws MeshError naming the third element at a face.
FacePairs pair_faces(const MeshData& data);

/// A side by its nodes, as the element has it.
Face face_of_side(const MeshData& data, Index element, Index side_of_element);
/// The first side of a face by its nodes.
Face first_face(const MeshData& data, const FacePairs& pairs, Index face);

/// Which elements have to be turned inside out for all to be oriented alike (#elements).
///
/// Elements that share a face have to see it in opposite directions, so orientation is walked from
/// element to element through each connected part, and a tangled mesh is oriented rightly too. Then
/// the part has its sign: plane and volume elements get a positive total area or volume, which the
/// boundary alone decides; surface elements are oriented as the first of their part.
///
/// Throws MeshError: an orientation that cannot be made consistent; neighbours that join the
/// corners of a shared quadrilateral in different orders; a plane or volume mesh without boundary.
std::vector<bool> elements_to_turn(const MeshData& data, const FacePairs& pairs);

/// The corners of all elements (as MeshData::element_nodes) with some elements turned.
std::vector<Index> turned_elements(const MeshData& data, const std::vector<bool>& turn);

}  // namespace winslow
