#pragma once

#include "gui/render/mesh_renderer.h"
#include "gui/render/space/space_camera.h"

struct ImDrawList;
struct ImFont;

namespace winslow::gui {

/// Of letters and lines, and of the ground on which letters stand.
struct MarkColors {
  Rgba ink, paper;
};

/// Where the axes point, bottom left in the viewport. size: of the letters, pixels.
void draw_axes(ImDrawList& list, ImFont& font, float size, const SpaceCamera& camera,
               const MarkColors& colors);

/// A bar of a round length, bottom right in the viewport; not in perspective, where a length is
/// no number of pixels.
void draw_scale_bar(ImDrawList& list, ImFont& font, float size, const SpaceCamera& camera,
                    const MarkColors& colors);

}  // namespace winslow::gui
