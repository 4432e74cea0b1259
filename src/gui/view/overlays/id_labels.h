#pragma once

#include <imgui.h>

#include <cstdint>
#include <vector>

#include "gui/view/overlays/id_label_drawing.h"
#include "gui/view/overlays/view_overlay.h"

namespace winslow::gui {

/// Ids of nodes and elements on the mesh: of those that are large enough on screen to hold their
/// number, and none of the others.
class IdLabels {
 public:
  void draw(ImDrawList& list, const ViewOverlay& overlay);

 private:
  /// What the labels depend on.
  struct Key {
    std::uint64_t generation = 0, shape = 0;
    Bounds seen{{0, 0}, {0, 0}};
    ScreenBox viewport;
    float scale = 0;
    bool nodes = false, elements = false;
    bool operator==(const Key&) const = default;
  };
  static Key key_of(const ViewOverlay& overlay);
  void find(const ViewOverlay& overlay);
  void find_nodes(const ViewOverlay& overlay);
  void find_elements(const ViewOverlay& overlay);

  Key key_;
  std::vector<IdLabel> labels_;
};

}  // namespace winslow::gui
