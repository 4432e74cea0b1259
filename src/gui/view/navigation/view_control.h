#pragma once

#include "gui/document/actions/actions.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/session.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/navigation/navigator.h"

namespace winslow::gui {

/// Holds the options and the scale of the view, and carries out the actions on them. Independent of
/// OpenGL and of widgets.
class ViewControl {
 public:
  /// screen_scale: pixels per unit of the layout that the screen asks for.
  ViewControl(Session& session, float screen_scale)
      : session_(session), navigator_(session, options_), scale_(screen_scale) {}

  const ViewOptions& options() const { return options_; }
  /// Restores the options kept from the last run.
  void set_options(const ViewOptions& options) { options_ = options; }
  const ViewState& state() const { return state_; }
  InterfaceScale& scale() { return scale_; }
  const InterfaceScale& scale() const { return scale_; }

  /// The present view and the history of views.
  const Navigator& navigator() const { return navigator_; }
  Navigator& navigator() { return navigator_; }
  // Shortcuts to members of navigator().
  const View& view() const { return navigator_.camera_control().view(); }
  /// For the mouse, which turns, pans and zooms.
  View& view() { return navigator_.camera_control().view(); }
  const Camera& camera() const { return navigator_.plane().view(); }
  const SpaceControl& space() const { return navigator_.space(); }
  SpaceControl& space() { return navigator_.space(); }

  void apply(const ViewAction& action) { Dispatch::to(*this, action); }
  void on(const action::EditView& a);
  void on(const action::InspectNode& a);
  void on(const action::ToggleRuler&) { state_.ruler = session_.document() && !state_.ruler; }
  void on(const action::BoxZoom&);
  void on(const action::GoTo& a);
  void on(const action::AskGoTo&);
  void on(const action::PreviewRoles& a) { state_.roles_previewed = a.on; }
  void on(const action::PinMagnifier&);
  void on(const action::StepScale& a);
  void on(const action::AddCut& a);
  void on(const action::AddCutAcrossView&);
  void on(const action::ShowLook& a);
  void on(const action::HoldCut& a) { state_.cut = a.cut; }

  /// Call in every frame, once it is known where in the framebuffer the mesh is drawn, pixels. True
  /// if another mesh is open than in the previous frame.
  bool begin_frame(double x, double y, double width, double height);
  /// Begins to look at the open mesh if it is not the previous one. True if so.
  bool look_at_another();
  /// Clears the requests that hold for one frame only.
  void end_requests() { state_.go_to_wanted = false; }

  /// Sets the place of the mouse over the mesh; none: it is elsewhere. seen: the visible place of a
  /// volume mesh there.
  void set_mouse(const std::optional<ScreenPoint>& mouse,
                 const std::optional<SeenPlace>& seen = {});
  /// Sets the state of the columns beside the mesh, which depends on the window's size.
  void set_columns(const ColumnState& columns) { state_.columns = columns; }
  void put_ruler_away() { state_.ruler = false; }
  /// Moves the divider between two meshes; by: a share of the viewport's width.
  void move_divider(double by);
  void disarm_box_zoom() { state_.box_zoom_armed = false; }
  /// Puts the magnifier away unless it is pinned.
  void release_magnifier();

 private:
  void suit_peel();

  Session& session_;
  ViewOptions options_;
  ViewState state_;
  Navigator navigator_;
  InterfaceScale scale_;
  std::uint64_t generation_ = 0;  // of the mesh that is looked at
  std::optional<ScreenPoint> mouse_;
};

}  // namespace winslow::gui
