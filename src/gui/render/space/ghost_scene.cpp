#include "gui/render/space/ghost_scene.h"

#include <utility>

#include "gui/render/space/scene_lists.h"

namespace winslow::gui {

SpaceScene build_ghost(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                       const VolumeStyle& style) {
  SpaceScene scene;
  scene.extent = space_bounds(mesh);
  scene.origin = scene.extent.centre();
  const SceneLists lists(mesh, scene.origin);
  SpaceLines feature{{}, style.ghost, style.feature_width, 0};
  SpaceLines other{{}, style.ghost, style.edge_width, 0};
  other.color[3] *= 0.6f;
  std::vector<SurfaceFace> bodies;
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    if (drawn_as_surface(boundary, look, f)) bodies.push_back(boundary.faces[f]);
  lists.add_edges({&feature, &other}, bodies, look.feature_angle);
  SpaceLines outlines{{}, style.ghost, style.feature_width, 0};
  for (const Plane& cut : look.cuts) lists.add_cut(outlines, bodies, cut);
  scene.lines = {std::move(other), std::move(feature), std::move(outlines)};
  return scene;
}

}  // namespace winslow::gui
