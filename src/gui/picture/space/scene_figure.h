#pragma once

#include <memory>
#include <span>

#include "gui/picture/figure/figure_scene.h"
#include "gui/render/space/space_camera.h"
#include "gui/render/space/space_scene.h"

namespace winslow::gui {

/// How a scene becomes vector graphics.
struct SceneFigureOptions {
  double line_scale = 1;  ///< widths of the scene's lines are times this
  bool axes = true, scale_bar = true;
  Rgb ink{0, 0, 0};  ///< of these
  double font_size = 10;
  /// More than that are better drawn as pixels.
  std::size_t most_polygons = 60'000;
};

/// What a camera sees of the parts of a scene, hidden surfaces and lines left out. camera: its
/// viewport, in points, has its corner at 0. Of too many polygons none, and no lines: it then
/// wants a raster.
FigureScene figure_of_scene(std::span<const std::shared_ptr<const SpaceScene>> parts,
                            std::span<const Plane> planes, const SpaceCamera& camera,
                            const SceneFigureOptions& options);

}  // namespace winslow::gui
