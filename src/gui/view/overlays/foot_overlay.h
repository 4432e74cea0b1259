#pragma once

#include <imgui.h>

#include "core/mesh/mesh.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/space/space_view.h"
#include "gui/view/mesh/volume_view.h"
#include "gui/view/overlays/view_overlay.h"

struct ImDrawList;
struct ImFont;

/// What stands at the foot of the view: the scale bar, and the mode that the mouse is in.
namespace winslow::gui {

/// A round length (1, 2 or 5 times a power of ten) of at most `most` units of the mesh.
double round_length(double most);

/// What the mouse does at present if that is not what it does as a rule; empty: it is.
std::string mode_text(const Session& session, const ViewState& state);

/// What mode_text() says, on a card. theme: its letters. room: its width, pixels.
void draw_mode(ImDrawList& list, const Theme& theme, const ImVec2& bottom_left, float room,
               const std::string& text);

/// room: of the view that no card covers.
void draw_foot(ImDrawList& list, const ViewOverlay& overlay, const ScreenBox& room,
               const std::string& mode);

/// In the middle: nothing of the mesh is in view.
void draw_out_of_view(ImDrawList& list, const ViewOverlay& overlay);

/// Whether a box of the plane shows any of a plane mesh: its boundary runs through the box, or the
/// box lies inside the mesh.
bool anything_in_view(const Topology& topology, const Coordinates& coordinates, const Bounds& box);

/// What is drawn over a mesh in space.
struct SpaceOverlay : ViewOverlay {
  const SpaceCamera& space;  ///< the view
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
