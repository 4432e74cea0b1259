#pragma once

#include <imgui.h>

#include "core/mesh/mesh.h"
#include "gui/view/overlays/view_overlay.h"

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

}  // namespace winslow::gui
