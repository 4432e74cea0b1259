#pragma once

#include "gui/render/mesh_renderer.h"
#include "gui/render/space/space_view.h"
#include "gui/view/mesh/volume_view.h"
#include "gui/view/overlays/view_overlay.h"

struct ImDrawList;
struct ImFont;

namespace winslow::gui {

/// What is drawn over a mesh in space.
struct SpaceOverlay : ViewOverlay {
  const SpaceView& space;  ///< the view
};

/// What belongs to the mesh, in pictures of it, too: pinned control volumes, axes and scale.
void draw_space_marks(ImDrawList& list, const SpaceOverlay& o, const VolumeView& picture);
/// The lowest pixel that is free above the marks at the left of the view's foot.
double space_marks_top(const ViewOverlay& o);

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
