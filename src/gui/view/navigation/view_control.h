#pragma once

#include <cstdint>
#include <optional>

#include "gui/document/actions/actions.h"
#include "gui/document/actions/dispatch.h"
#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/navigation/space_control.h"
#include "gui/view/navigation/view_history.h"

namespace winslow::gui {

/// Where the user looks and what is drawn: carries out the actions on the view. Knows nothing of
/// OpenGL or of widgets.
class ViewControl {
 public:
  /// screen_scale: pixels per unit of the layout that the screen wants.
  ViewControl(Session& session, float screen_scale)
      : session_(session), plane_(session), space_(session), scale_(screen_scale) {}

  void apply(const ViewAction& action) { Dispatch::to(*this, action); }

  const ViewOptions& options() const { return options_; }
  /// As they were kept from the last run.
  void set_options(const ViewOptions& options) { options_ = options; }
  const ViewState& state() const { return state_; }
  /// Of the open mesh.
  const View& view() const { return look().view(); }
  /// For the mouse, which turns, pans and zooms.
  View& view() { return look().view(); }
  /// Of plane meshes.
  const PlaneView& plane() const { return plane_.view(); }
  const Camera& camera() const { return plane().camera(); }
  /// Of volume meshes.
  const SpaceControl& space() const { return space_; }
  SpaceControl& space() { return space_; }
  InterfaceScale& scale() { return scale_; }
  const InterfaceScale& scale() const { return scale_; }

  /// In every frame, when it is known where in the framebuffer the mesh is drawn, pixels. True if
  /// another mesh is open than in the frame before.
  bool begin_frame(double x, double y, double width, double height);
  /// Looks at the mesh that is open if it is another than before. True if it is.
  bool follow_mesh();
  /// In every frame. mouse_busy: the mouse is changing the view. seconds: since the last frame.
  void observe(bool mouse_busy, double seconds) {
    history_.observe(view().looked_at(), mouse_busy, seconds);
  }
  /// What was asked of this frame alone is done.
  void end_requests() { state_.go_to_wanted = false; }

  /// Where the mouse is over the mesh; none: it is elsewhere. seen: what is there, of a volume
  /// mesh.
  void set_mouse(const std::optional<ScreenPoint>& mouse,
                 const std::optional<SeenPlace>& seen = {});
  /// As the window has room for the columns beside the mesh.
  void set_columns(const ColumnState& columns) { state_.columns = columns; }
  void put_ruler_away() { state_.ruler = false; }
  /// A card at the foot of the viewport: what one goes to is shown above it.
  void set_card(const std::optional<ScreenBox>& card) { card_ = card; }
  const std::optional<ScreenBox>& card() const { return card_; }
  /// Moves the divider between two meshes; by: a share of the viewport's width.
  void move_divider(double by);
  void disarm_box_zoom() { state_.box_zoom_armed = false; }
  /// Puts the magnifier away unless it is pinned.
  void release_magnifier();

 private:
  friend class Dispatch;
  void on(const action::EditView& a);
  void on(const action::InspectNode& a);
  void on(const action::FitView&);
  void on(const action::FitSelection&);
  void on(const action::FitBodies&);
  void on(const action::FitMarkers& a);
  void on(const action::ToggleRuler&) { state_.ruler = session_.document() && !state_.ruler; }
  void on(const action::LookAt& a);
  void on(const action::BoxZoom&);
  void on(const action::BackView&) { go(history_.back(view().looked_at())); }
  void on(const action::ForwardView&) { go(history_.forward()); }
  void on(const action::GoTo& a);
  void on(const action::AskGoTo&);
  void on(const action::PreviewRoles& a) { state_.roles_previewed = a.on; }
  void on(const action::PinMagnifier&);
  void on(const action::StepScale& a);
  void on(const action::ZoomToScreen& a);
  void on(const action::LookFrom& a);
  void on(const action::AddCut& a);
  void on(const action::AddCutAcrossView&);
  void on(const action::ShowLook& a);
  void on(const action::HoldCut& a) { state_.cut = a.cut; }
  /// Of the open mesh.
  const LookControl& look() const;
  LookControl& look();
  void suit_peel();
  void go(const std::optional<LookedAt>& place) {
    if (place) view().look_at(*place);
  }
  void leave() { history_.leave(view().looked_at()); }

  Session& session_;
  ViewOptions options_;
  ViewState state_;
  PlaneControl plane_;
  SpaceControl space_;
  ViewHistory history_;
  InterfaceScale scale_;
  std::uint64_t generation_ = 0;  // of the mesh that the camera was set up for
  std::optional<ScreenPoint> mouse_;
  std::optional<ScreenBox> card_;
};

}  // namespace winslow::gui
