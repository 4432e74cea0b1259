#include "core/strategy/surface_shape.h"

#include "core/error.h"
#include "core/geometry/remembered_feet.h"

namespace winslow {

std::shared_ptr<const SurfaceShape> surface_shape(const MeshState& state,
                                                  const SlideOptions& options) {
  if (options.given())
    throw UsageError(
        "sliding markers and periodic pairs: not for a surface mesh, all nodes of which slide");
  const SurfaceShape* known = state.surface.get();
  if (known && known->feature_angle == options.feature_angle && known->features == options.features)
    return state.surface;
  auto shape = std::make_shared<SurfaceShape>();
  shape->given = known ? known->given : state.mesh.coordinates;
  shape->feature_angle = options.feature_angle;
  shape->features = options.features;
  shape->boundary = SlidingBoundary::find(*state.mesh.topology, shape->given, {},
                                          options.feature_angle, options.features);
  shape->normals =
      std::make_shared<const ElementNormals>(state.mesh.topology, shape->given, shape->boundary);
  return shape;
}

std::vector<Vec3> reference_normals(const MeshState& state, const Coordinates& x) {
  return state.surface ? state.surface->normals->at(x, 0) : std::vector<Vec3>();
}

void slide_on_surface(const SurfaceShape& shape, const Coordinates& x, NodeClasses& classes) {
  const Topology& topology = classes.topology();
  const auto geometry =
      std::make_shared<const RememberedFeet>(shape.boundary.geometry, topology.node_count());
  classes.set_fixed(topology.interior_nodes());
  for (const SlidingPart& part : shape.boundary.parts) classes.set_sliding(part.nodes, geometry, x);
  classes.set_element_normals(
      std::make_shared<const ElementNormals>(shape.normals->asking(geometry)));
}

}  // namespace winslow
