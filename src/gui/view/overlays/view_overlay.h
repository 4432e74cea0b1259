#pragma once

#include <imgui.h>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/mesh/mesh_view.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Place of a magnifier, and the part of the view that it magnifies.
struct Inset {
  Camera camera;     ///< its viewport is the inset's place in the framebuffer
  ScreenBox source;  ///< what it magnifies
  bool pinned = false;
  ScreenBox frame() const { return camera.viewport(); }
};

/// The inset of a view; none if the magnifier is off, or follows a mouse that is elsewhere.
/// scale: of the interface.
std::optional<Inset> magnifier_inset(const Magnifier& magnifier, const Camera& camera,
                                     const ScreenPoint& mouse, bool mouse_over, double scale);

/// The magnification after so many notches of the wheel.
double turned_factor(double factor, double notches);

/// Data for what is drawn over the mesh as an aid to viewing.
struct ViewOverlay {
  const Session& session;
  const ViewOptions& options;
  const ViewState& state;
  const View& view;
  const Theme& theme;
};

/// Draws the node, element or face in focus, above everything that hides it.
void draw_focus(ImDrawList& list, const ViewOverlay& overlay);
/// Draws the pinned control volumes of a plane mesh.
void draw_pins(ImDrawList& list, const ViewOverlay& overlay);
/// Draws nodes of the boundary and arrows along it, as far as there is room for them.
void draw_rim(ImDrawList& list, const ViewOverlay& overlay);
/// Labels a comparison: the divider and the names of both sides, or of the ghost. whole: the whole
/// view, of which the mesh now may have only a part.
void draw_comparison(ImDrawList& list, const ViewOptions& options, const Theme& theme,
                     const ScreenBox& whole);
/// The part of a room that the labels of a comparison leave free in the top left corner.
ScreenBox room_below_comparison(ScreenBox room, const ViewOptions& options, const Theme& theme);
/// Draws the box to zoom to (pixels).
void draw_zoom_box(ImDrawList& list, const Theme& theme, const ScreenBox& box);
/// Marks the place that a pinned magnifier shows. Drawn below the inset, in case the two overlap.
void draw_inset_source(ImDrawList& list, const Theme& theme, const Inset& inset);
/// Draws the frame of a magnifier.
void draw_inset_frame(ImDrawList& list, const ViewOverlay& overlay, const Inset& inset);

/// Draws text on a small card; returns the card's size.
ImVec2 draw_tag(ImDrawList& list, const Theme& theme, const ImVec2& at, const char* text);

/// The magnifier of a frame of the window or of a picture. Its mesh is painted in the order of the
/// draw list: above what was drawn before, below what comes after.
class Lens {
 public:
  explicit Lens(MeshView& mesh) : mesh_(mesh) {}
  Lens(const Lens&) = delete;  // draw lists hold its address
  Lens& operator=(const Lens&) = delete;

  void place(std::optional<Inset> inset) { inset_ = std::move(inset); }
  /// None if nothing is magnified.
  const std::optional<Inset>& inset() const { return inset_; }
  /// Sets the part of the frame that is painted next.
  void set_tile(const ScreenBox& tile) { tile_ = tile; }
  /// The lens must stay until the list is painted.
  void draw(ImDrawList& list, const ViewOverlay& overlay);

 private:
  void paint() const;

  MeshView& mesh_;
  std::optional<Inset> inset_;
  ScreenBox tile_;
};

/// Draws the outline of the region outside which nothing moves (SmoothOptions::keep_outside),
/// dashed, in the plane or in space. A circle without a centre is drawn about the selection, if
/// there is one.
void draw_region(ImDrawList& list, const Session& session, const View& view, const Theme& theme);

}  // namespace winslow::gui
