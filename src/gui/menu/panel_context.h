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

/// All that a panel or a command sees, and where it puts what the user wants.
struct PanelContext {
  const Session& session;
  const ViewOptions& view;
  const ViewState& view_state;
  const Theme& theme;
  ActionQueue& actions;
  const Capture& capture;
  const RecentFiles& recent;
  const DemoPlayer& demo;
  const BeforeMesh* before = nullptr;  ///< what the mesh is compared with
  /// The mesh in the picture, that numbers beside it are to be of; null: none yet.
  const ShownMesh* shown = nullptr;

  template <class A>
  void emit(A a) const {
    actions.push_back(Action(std::move(a)));
  }
  /// Emits what `change` does to a copy of the view's options.
  template <class Change>
  void edit_view(Change&& change) const {
    ViewOptions after = view;
    change(after);
    emit(action::EditView{difference(view, after)});
  }
  // Emit what leads from the options as they are to others; of the view, which panels edit in every
  // frame, only if there is something.
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
  /// The picture is that of the session's mesh, not of the one before.
  bool picture_follows() const { return shown && shown->shape == session.shape(); }
  const Topology* topology() const { return session.topology().get(); }
};

/// A panel: draws a part of the studio into the current ImGui window, in every frame that shows it,
/// and emits actions. No panel knows another.
using DrawPanel = std::function<void(const PanelContext&)>;
/// One that keeps something from frame to frame, in a class with draw().
template <class P>
DrawPanel panel_of() {
  return [panel = std::make_shared<P>()](const PanelContext& context) { panel->draw(context); };
}

}  // namespace winslow::gui
