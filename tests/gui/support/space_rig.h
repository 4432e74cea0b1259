#pragma once

#include <string>
#include <string_view>

#include "gui/menu/user_command.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

/// A studio that shows a mesh in space.
struct SpaceRig : Rig {
  using Rig::Rig;

  const SpaceControl& space() const { return bench->view_control().space(); }
  const ViewOptions& options() const { return bench->view_control().options(); }
  const ViewState& state() const { return bench->view_control().state(); }
  const VolumeView& picture() const { return bench->pane().mesh_view().volume(); }
  const VolumeScenes& scenes() const { return *picture().scenes(); }
  ScreenPoint at(const Vec3& point) const { return space().view().project(point).at; }
  /// Why a command cannot be given now; empty: it can.
  std::string blocked(std::string_view id) {
    ActionQueue actions;
    const PanelContext context{session(), options(),        state(),         bench->theme(),
                               actions,   bench->capture(), bench->recent(), bench->demo(),
                               nullptr,   nullptr};
    return why_blocked(user_command(id), context);
  }
};

}  // namespace winslow::gui::test
