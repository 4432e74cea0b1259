#pragma once

#include "gui/base/screen.h"
#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/view/mesh/volume_view.h"

namespace winslow::gui {

/// The mouse over the mesh.
struct PointerState {
  ScreenPoint position;
  bool over = false;  ///< over the viewport, with nothing of the interface in between
  bool left = false, middle = false, right = false;
  double wheel = 0;  ///< notches; up zooms in
  bool shift = false, control = false, alt = false;
  bool cancel = false;                               ///< Esc
  bool accept = false;                               ///< Enter
  bool key_x = false, key_y = false, key_z = false;  ///< keep a drag to an axis
  std::u32string text;                               ///< typed since the last frame
  bool erase = false, next = false;                  ///< Backspace, Tab
  /// Another tool uses the click under way: it selects nothing. A drag still belongs to the
  /// viewport.
  bool click_taken = false;
};

/// What the mouse acts upon.
struct ViewportScene {
  const Session& session;
  const VolumeView& picture;  ///< of a volume mesh
  const ViewOptions& options;
  std::vector<Index> taken_out = {};    ///< markers that the mouse passes through, ascending
  std::optional<std::size_t> cut = {};  ///< the cut with a handle
  double reach = 0;                     ///< of the selection around its pivot, units of the mesh
  double scale = 1;                     ///< of the interface; sizes of handles grow with it
  bool box_zoom = false;                ///< the next drag draws the box to zoom to
  bool look_only = false;               ///< a tool uses the clicks: nothing can be grabbed
  bool inspects = false;                ///< clicks on nodes show them in the tab VCV
  bool wheel_is_lens = false;           ///< the wheel belongs to the magnifier
};

/// The input of one frame: the mouse, what it acts upon, the view, and the queue for its actions.
struct PointerFrame {
  const PointerState& pointer;
  const ViewportScene& scene;
  View& view;
  ActionQueue& actions;

  /// True if clicks pick nodes.
  bool picks_nodes() const {
    return (pointer.alt || scene.inspects) && !scene.box_zoom && !scene.look_only;
  }
};

// Distances within which the mouse counts as near, framebuffer pixels at scale 1.
inline constexpr double drag_threshold = 4;  // shorter movements are clicks
inline constexpr double boundary_radius = 7;
inline constexpr double node_radius = 10;

}  // namespace winslow::gui
