#pragma once

#include <span>
#include <vector>

#include "core/mesh/surface_faces.h"

namespace winslow {

/// Which faces of a boundary enclose bodies (#faces, 1 or 0): a box around a wing does, the wing
/// does not, though both may hang together in a plane of symmetry. All are 0 where nothing is
/// enclosed: of a solid body, that is, which is to be seen from outside.
///
/// Parts are faces of one marker that hang together by edges. A part encloses if most of its area
/// lies on the convex hull of the mesh, up to 1 % of the mesh's extent; the others are bodies
/// if they lie inside or bound it from inside: the sum of (c - c_part) . a over the faces of
/// the boundary among them, of centres c and area vectors a, is not positive.
std::vector<unsigned char> enclosing_faces(const Mesh& mesh, std::span<const SurfaceFace> faces);

}  // namespace winslow
