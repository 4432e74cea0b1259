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
  /// The picture is that of the session's mesh, not of the one before.
  bool picture_follows() const { return shown && shown->shape == session.shape(); }
  const Topology* topology() const { return session.topology().get(); }
};

/// A part of the studio: draws itself into the current ImGui window from a view of the session and
/// emits actions. No panel knows another.
class Panel {
 public:
  virtual ~Panel() = default;
  virtual void draw(const PanelContext& context) = 0;
};

}  // namespace winslow::gui
