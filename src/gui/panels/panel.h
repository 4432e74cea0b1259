#pragma once

#include <utility>

#include "gui/files/recent_files.h"
#include "gui/studio/actions.h"
#include "gui/studio/before_mesh.h"
#include "gui/studio/session.h"
#include "gui/studio/theme.h"
#include "gui/studio/view_options.h"
#include "gui/studio/view_state.h"

namespace winslow::gui {

class Capture;
class DemoPlayer;

/// All that a panel sees, and where it puts what the user wants.
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

  template <class A>
  void emit(A a) const {
    actions.emplace_back(std::move(a));
  }
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
