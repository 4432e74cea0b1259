#pragma once

#include <memory>

#include "gui/document/selection/picked_place.h"
#include "gui/panels/panel.h"

namespace winslow::gui {

/// The menu of a right click: what can be done with the body, the node and the element there.
class ContextMenu : public Panel {
 public:
  void draw(const PanelContext& context) override;
  /// Comes up beside the mouse.
  void open(const PickedPlace& place);

 private:
  PickedPlace place_;
  std::shared_ptr<const Topology> topology_;  ///< that the numbers of the place belong to
  bool wanted_ = false;
};

}  // namespace winslow::gui
