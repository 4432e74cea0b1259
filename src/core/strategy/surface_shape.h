#pragma once

#include "core/geometry/element_normals.h"
#include "core/geometry/sliding_boundary.h"
#include "core/problem/node_classes.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/slide_options.h"

namespace winslow {

/// The shape on which the nodes of a surface mesh stay: that of the mesh as given, even after
/// repeated smoothing.
struct SurfaceShape {
  Coordinates given;
  FeatureRules rules;
  /// The reference surface; null: the mesh as given.
  std::shared_ptr<const ReferenceSurface> reference;
  SlidingBoundary boundary;
  std::shared_ptr<const ElementNormals> normals;
};

/// The shape of a surface mesh: that of the state, recomputed from the mesh as given if the options
/// differ. Throws UsageError for options that only other kinds of meshes have.
std::shared_ptr<const SurfaceShape> surface_shape(const MeshState& state,
                                                  const ResolvedSlide& options);

/// The shape of a surface mesh in its present position; null if none is found, and for other
/// meshes.
std::shared_ptr<const SurfaceShape> own_shape(const Mesh& mesh);

/// Reference normals of the elements at x; empty if the state has no surface yet, or for another
/// kind of mesh.
std::vector<Vec3> reference_normals(const MeshState& state, const Coordinates& x);

/// Lets the nodes inside regions and, if enabled, on feature lines slide. Fixes the other nodes and
/// nodes_to_hold().
void slide_on_surface(const SurfaceShape& shape, const Coordinates& x, NodeClasses& classes);

/// The nodes of a surface mesh in which regions meet, with the classes that slide_on_surface() set.
InterfaceReport interfaces_of_surface(const SurfaceShape& shape, const NodeClasses& classes);

/// Nodes that must be fixed, besides those fixed anyway, to make the smoothed surface mesh unique.
/// Conformal maps do not change the shapes of triangles, so a mesh can move at no cost under the
/// conformal maps of its surface to itself. Three distant nodes remove this freedom on a
/// sphere-like surface (borders disregarded), one node on a torus-like one; other surfaces need
/// none. slides: for each node.
std::vector<Index> nodes_to_hold(const Topology& topology, const Coordinates& x,
                                 const std::vector<bool>& slides);

}  // namespace winslow
