#pragma once

#include "gui/render/space/space_view.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/space_viewport.h"

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

}  // namespace winslow::gui
