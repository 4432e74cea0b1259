#pragma once

#include <optional>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/view/tools/node_index.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// Picks nodes with the mouse: the one under it lights up, a click inspects it. Only clicks are the
/// tool's; drags are the viewport's, wherever they begin.
class NodeTool {
 public:
  /// active: clicks near nodes are for the tool. Returns true if the click under way is.
  bool update(const PointerState& pointer, bool active, double scale, const Session& session,
              const View& view, ActionQueue& actions);
  /// The node under the mouse, if one is near enough to be meant. There is a mesh.
  std::optional<Index> node_at(const PointerState& pointer, double scale, const Session& session,
                               const View& view);

 private:
  NodePicker picker_;
  std::optional<Index> hovered_, pressed_;
  ScreenPoint press_;
  bool was_down_ = false;
};

}  // namespace winslow::gui
