#pragma once

#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/files/recent_files.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/mesh/mesh_layer.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

class Capture;
class DemoPlayer;

/// The input of panels and commands, and the queue for the user's actions.
struct PanelContext {
  const Session& session;
  const ViewOptions& view;
  const ViewState& view_state;
  const Theme& theme;
  ActionQueue& actions;
  const Capture& capture;
  const RecentFiles& recent;
  const DemoPlayer& demo;
  const BeforeMesh* before = nullptr;  ///< state with which the mesh is compared
  /// The mesh in the picture, to which displayed numbers must refer; null: none yet.
  const ShownMesh* shown = nullptr;

  template <class A>
  void emit(A a) const {
    actions.push_back(Action(std::move(a)));
  }
  /// Applies `change` to a copy of the view's options and emits the difference.
  template <class Change>
  void edit_view(Change&& change) const {
    ViewOptions after = view;
    change(after);
    emit(action::EditView{difference(view, after)});
  }
  // Emit the difference between the present options and others. For the view, which panels edit in
  // every frame, only if there is a difference.
  void edit(const ViewOptions& after) const {
    if (const auto changes = difference(view, after); !changes.empty())
      emit(action::EditView{changes});
  }
  void edit(const SmoothOptions& after) const {
    emit(action::EditSmoothOptions{difference(session.solver_settings().smooth_options(), after)});
  }
  void edit(const MotionOptions& after) const {
    emit(action::EditMotionOptions{difference(session.solver_settings().motion_options(), after)});
  }
  /// True if the picture shows the session's present mesh, not an earlier one.
  bool picture_follows() const { return shown && shown->shape == session.shape(); }
  const Topology* topology() const { return session.topology().get(); }
};

/// A panel: draws a part of the studio into the current ImGui window, in every frame in which it is
/// visible, and emits actions. Panels do not depend on one another.
using DrawPanel = std::function<void(const PanelContext&)>;
/// A panel with state, made of a class with draw().
template <class P>
DrawPanel panel_of() {
  return [panel = std::make_shared<P>()](const PanelContext& context) { panel->draw(context); };
}

}  // namespace winslow::gui
