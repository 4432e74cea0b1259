#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/search/box_tree.h"
#include "gui/render/space/space_scene.h"

namespace winslow::gui {

/// What is seen at a place.
struct SpaceHit {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};  ///< of length 1, towards the viewer
  Index element = -1;    ///< that shows there
  Index marker = -1;     ///< of the boundary; -1: none, or a cut through the mesh
};

/// The nearest triangle that a ray hits, of scenes that are clipped by these planes: what is drawn
/// is what can be hit. See-through surfaces are passed through.
std::optional<SpaceHit> pick_in_scene(std::span<const std::shared_ptr<const SpaceScene>> parts,
                                      std::span<const Plane> planes, const Ray<3>& ray);

}  // namespace winslow::gui
