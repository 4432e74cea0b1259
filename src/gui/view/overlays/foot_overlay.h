#pragma once

#include <imgui.h>

#include "core/mesh/mesh.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/space/space_view.h"
#include "gui/view/mesh/volume_view.h"
#include "gui/view/overlays/view_overlay.h"

struct ImDrawList;
struct ImFont;

/// The foot of the view: the scale bar and the mode of the mouse.
namespace winslow::gui {

/// A round length (1, 2 or 5 times a power of ten) of at most `most` units of the mesh.
double round_length(double most);

/// Text for the mode of the mouse; empty: it is in its default mode.
std::string mode_text(const Session& session, const ViewState& state);

/// Draws the text of mode_text() on a card. theme: of the letters. room: width of the card, pixels.
void draw_mode(ImDrawList& list, const Theme& theme, const ImVec2& bottom_left, float room,
               const std::string& text);

/// room: the part of the view that no card covers.
void draw_foot(ImDrawList& list, const ViewOverlay& overlay, const ScreenBox& room,
               const std::string& mode);

/// Says in the middle of the view that nothing of the mesh is in view.
void draw_out_of_view(ImDrawList& list, const ViewOverlay& overlay);

/// Whether a box of the plane shows any of a plane mesh: its boundary runs through the box, or the
/// box lies inside the mesh.
bool anything_in_view(const Topology& topology, const Coordinates& coordinates, const Bounds& box);

/// Data for what is drawn over a mesh in space.
struct SpaceOverlay : ViewOverlay {
  const SpaceCamera& space;  ///< the view
};

/// Draws the marks that pictures have, too: pinned control volumes, axes and scale.
void draw_space_marks(ImDrawList& list, const SpaceOverlay& o, const VolumeView& picture);
/// The lowest pixel that is free above the marks at the left of the view's foot.
double space_marks_top(const ViewOverlay& o);

/// Colours of marks: ink for letters and lines, paper for the ground beneath letters.
struct MarkColors {
  Rgba ink, paper;
};

/// Draws the directions of the axes, bottom left in the viewport. size: of the letters, pixels.
void draw_axes(ImDrawList& list, ImFont& font, float size, const SpaceCamera& camera,
               const MarkColors& colors);

/// Draws a bar of a round length, bottom right in the viewport. Not in perspective, where a length
/// has no fixed number of pixels.
void draw_scale_bar(ImDrawList& list, ImFont& font, float size, const SpaceCamera& camera,
                    const MarkColors& colors);

}  // namespace winslow::gui
