#pragma once

#include "gui/picture/frame/picture_frame.h"
#include "gui/render/space/space_camera.h"

struct ImDrawList;
struct ImFont;

namespace winslow::gui {

/// Where the axes point, bottom left in the viewport. size: of the letters, pixels.
void draw_axes(ImDrawList& list, ImFont& font, float size, const SpaceCamera& camera,
               const PictureTheme& theme);

/// A bar of a round length, bottom right in the viewport; not in perspective, where a length is
/// no number of pixels.
void draw_scale_bar(ImDrawList& list, ImFont& font, float size, const SpaceCamera& camera,
                    const PictureTheme& theme);

}  // namespace winslow::gui
