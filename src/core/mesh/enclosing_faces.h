#pragma once

#include "core/mesh/mesh.h"
#include "core/mesh/surface_faces.h"

/// The faces of bodies in a volume mesh:
///
///     const auto faces = winslow::boundary_faces(*mesh.topology);
///     const auto enclosing = winslow::enclosing_faces(mesh, faces);
///     for (std::size_t f = 0; f < faces.size(); ++f)
///       if (enclosing[f] == 0) std::puts(winslow::nodes_text(faces[f].nodes).c_str());
namespace winslow {

/// Which faces of a boundary enclose bodies (#faces, 1 or 0): those of a box around a wing, but not
/// the wing's, although both may be connected in a plane of symmetry. All are 0 if the mesh
/// encloses no body, as for the mesh of a solid.
///
/// A part is a set of faces of one marker that are connected by edges. A part encloses if most of
/// its area lies on the convex hull of the mesh, up to 1 % of the extent of the mesh. The other
/// parts are bodies if the sum of (c - c_part) . a over their faces, with centres c and area
/// vectors a, is not positive: they bound the mesh from inside. Faces inside the mesh do not count
/// in this sum.
std::vector<unsigned char> enclosing_faces(const Mesh& mesh, std::span<const SurfaceFace> faces);

}  // namespace winslow
