#pragma once

#include "gui/document/actions/actions.h"
#include "gui/document/actions/document_actions.h"
#include "gui/render/view.h"
#include "gui/view/navigation/camera_control.h"

namespace winslow::gui {

/// History of views, to go back and forward in. A view is recorded once it has rested; views passed
/// while panning and zooming are not.
class ViewHistory {
 public:
  /// Forgets everything; call it for another mesh.
  void clear();
  /// Call in every frame. busy: the mouse is changing the view. seconds: since the last frame.
  void observe(const LookedAt& now, bool busy, double seconds);
  /// Records the present view; call it before the view jumps elsewhere.
  void leave(const LookedAt& now);

  bool can_go_back(const LookedAt& now) const;
  bool can_go_forward() const { return position_ + 1 < views_.size(); }
  /// The previous and the next view; none: there is none.
  std::optional<LookedAt> back(const LookedAt& now);
  std::optional<LookedAt> forward();

 private:
  std::vector<LookedAt> views_;
  std::size_t position_ = 0;
  LookedAt last_;
  double rested_ = 0;  // seconds
};

/// The present view and the history of views. Independent of OpenGL and of widgets.
class Navigator {
 public:
  /// options: what is drawn of the mesh, which outlives this object.
  Navigator(const Session& session, ViewOptions& options)
      : session_(session), options_(options), plane_(session), space_(session) {}

  /// The control of the open mesh's camera.
  const CameraControl& camera_control() const {
    if (session_.in_space()) return space_;
    return plane_;
  }
  CameraControl& camera_control() {
    if (session_.in_space()) return space_;
    return plane_;
  }
  /// The controls of plane meshes and of meshes in space.
  const PlaneControl& plane() const { return plane_; }
  PlaneControl& plane() { return plane_; }
  const SpaceControl& space() const { return space_; }
  SpaceControl& space() { return space_; }

  void apply(const CameraAction& action) { Dispatch::to(*this, action); }
  void on(const action::FitView&) { jump(&CameraControl::fit_all); }
  void on(const action::FitBodies&) { jump(&CameraControl::fit_bodies); }
  void on(const action::FitMarkers& a) { jump(&CameraControl::fit_markers, a.markers); }
  void on(const action::FitSelection&) {
    jump(&CameraControl::fit_markers, session_.selection().markers());
  }
  void on(const action::LookAt& a) {
    jump(&CameraControl::look_around, a.point, a.radius);
    stay_above_card();
  }
  void on(const action::ZoomToScreen& a) { jump(&CameraControl::zoom_to, a.box, a.depth); }
  void on(const action::LookFrom& a);
  void on(const action::BackView&) { look_there(history_.back(looked_at())); }
  void on(const action::ForwardView&) { look_there(history_.forward()); }

  /// Looks at an item of the open mesh and what touches it.
  void go_to(const MeshItem& item);
  /// Sets the view of a mesh in space to that of a look. Its cuts are part of the options and are
  /// not set here.
  void show(const SpaceLook& look);
  /// Sets the card at the foot of the viewport; targets of go_to() are shown above it.
  void set_card(const std::optional<ScreenBox>& card) { card_ = card; }
  const std::optional<ScreenBox>& card() const { return card_; }

  // To be called in every frame.
  /// area: part of the framebuffer in which the mesh is drawn, pixels.
  void set_viewport(const ScreenBox& area);
  /// Keeps the view of the previous mesh for when it is opened again; call it when another mesh, or
  /// none, is open.
  void leave_mesh();
  /// Looks at the mesh that is open, if any.
  void begin_mesh();
  /// mouse_busy: the mouse is changing the view. seconds: since the last frame.
  void observe(bool mouse_busy, double seconds) {
    history_.observe(looked_at(), mouse_busy, seconds);
  }

  LookedAt looked_at() const { return camera_control().view().looked_at(); }
  bool can_go_back() const { return history_.can_go_back(looked_at()); }
  bool can_go_forward() const { return history_.can_go_forward(); }

 private:
  void look_there(const std::optional<LookedAt>& place) {
    if (place) camera_control().view().look_at(*place);
  }
  /// Call before the view jumps elsewhere.
  void leave() { history_.leave(looked_at()); }
  template <class... Parameters, class... Arguments>
  void jump(void (CameraControl::*how)(Parameters...), const Arguments&... arguments) {
    if (!session_.document()) return;
    leave();
    (camera_control().*how)(arguments...);
  }
  /// Call after a jump: moves its target out from under the card.
  void stay_above_card() {
    if (card_ && session_.document()) camera_control().look_above(*card_);
  }

  const Session& session_;
  ViewOptions& options_;
  PlaneControl plane_;
  SpaceControl space_;
  ViewHistory history_;
  std::optional<ScreenBox> card_;
};

}  // namespace winslow::gui
