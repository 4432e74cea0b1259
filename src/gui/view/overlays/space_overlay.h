#pragma once

#include "gui/render/mesh_renderer.h"
#include "gui/render/space/space_view.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/space_viewport.h"

struct ImDrawList;
struct ImFont;

namespace winslow::gui {

/// What is drawn over a volume mesh.
struct SpaceOverlay {
  const Session& session;
  const ViewOptions& options;
  const ViewState& state;
  const SpaceView& view;
  const Theme& theme;
};

/// What belongs to the mesh, in pictures of it, too: pinned control volumes, the item that was gone
/// to, axes and scale.
void draw_space_marks(ImDrawList& list, const SpaceOverlay& o, const VolumeView& picture);
/// The lowest pixel that is free above the marks at the left of the view's foot.
double space_marks_top(const SpaceOverlay& o);
/// For the mouse's sake: handles, what is about to be moved, the point about which the view turns.
void draw_space_handles(ImDrawList& list, const SpaceOverlay& o, const SpaceViewport& viewport);

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
