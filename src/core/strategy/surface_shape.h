#pragma once

#include "core/geometry/element_normals.h"
#include "core/geometry/sliding_boundary.h"
#include "core/problem/node_classes.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/slide_options.h"

namespace winslow {

/// The shape that the nodes of a surface mesh stay on: that of the mesh as it was given, however
/// often it is smoothed since.
struct SurfaceShape {
  Coordinates given;
  FeatureRules rules;
  /// The surface that it is of; null: the mesh as given.
  std::shared_ptr<const ReferenceSurface> reference;
  SlidingBoundary boundary;
  std::shared_ptr<const ElementNormals> normals;
};

/// The shape of a surface mesh: the one that the state has, found anew from the same mesh as given
/// where the options differ. Throws UsageError for options that are for other meshes.
std::shared_ptr<const SurfaceShape> surface_shape(const MeshState& state,
                                                  const ResolvedSlide& options);

/// The shape that a surface mesh has as it is; null where none is found, and of other meshes.
std::shared_ptr<const SurfaceShape> own_shape(const Mesh& mesh);

/// Reference normals of the elements where x has them; empty if the state has no surface yet, or is
/// of another kind of mesh.
std::vector<Vec3> reference_normals(const MeshState& state, const Coordinates& x);

/// The nodes inside regions and, if so, on feature lines slide, the others stay, and with them
/// nodes_to_hold().
void slide_on_surface(const SurfaceShape& shape, const Coordinates& x, NodeClasses& classes);

/// Nodes that have to be held besides those that stay anyway, for a surface mesh to have one place
/// to go to. Shapes of triangles do not change under conformal maps, so that a mesh could move for
/// nothing with all those of its surface to itself: three nodes far from one another hold what is,
/// but for its borders, like a sphere, one what is like a torus; of all others there are none.
/// slides: of each node.
std::vector<Index> nodes_to_hold(const Topology& topology, const Coordinates& x,
                                 const std::vector<bool>& slides);

}  // namespace winslow
