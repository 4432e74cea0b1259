#pragma once

#include <imgui.h>

#include <optional>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/tools/magnifier.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// What is drawn over the mesh to help looking at it.
struct ViewOverlay {
  const Session& session;
  const ViewOptions& options;
  const ViewState& state;
  const View& view;
  const Theme& theme;
};

/// The node or element that was gone to.
void draw_focus(ImDrawList& list, const ViewOverlay& overlay);
/// Nodes of the boundary and arrows along it, as far as there is room for them.
void draw_rim(ImDrawList& list, const ViewOverlay& overlay);
/// What is compared with what: the divider and the names of both sides, or of the ghost.
void draw_comparison(ImDrawList& list, const ViewOverlay& overlay);
/// The same in a view of which the mesh now may have a part.
void draw_comparison(ImDrawList& list, const ViewOptions& options, const Theme& theme,
                     const ScreenBox& whole);
/// The box that the mouse draws to zoom to (pixels).
void draw_zoom_box(ImDrawList& list, const Theme& theme, const ScreenBox& box);
/// Where a pinned magnifier looks: below its picture, should they overlap.
void draw_inset_source(ImDrawList& list, const Theme& theme, const Inset& inset);
/// Frame of a magnifier.
void draw_inset_frame(ImDrawList& list, const ViewOverlay& overlay, const Inset& inset);

/// Text on a small card; returns its size.
ImVec2 draw_tag(ImDrawList& list, const Theme& theme, const ImVec2& at, const char* text);

}  // namespace winslow::gui
