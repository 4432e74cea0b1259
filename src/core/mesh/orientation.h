#pragma once

#include <vector>

#include "core/mesh/face_pairs.h"
#include "core/mesh/mesh_data.h"

namespace winslow {

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
