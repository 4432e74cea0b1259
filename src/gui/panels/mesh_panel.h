#pragma once

#include "core/mesh/element_type.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Of a file of several zones: the one that is open, to choose another. Nothing of other files.
class ZonePanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

/// What the open mesh is: its extents, how many nodes and elements of which type, edges by marker.
class MeshPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  /// Of one connectivity.
  struct Counts {
    std::shared_ptr<const Topology> topology;
    std::array<Index, all_element_types.size()> of_type{};
    Index boundary_nodes = 0, unused_nodes = 0;
  };
  void count(const std::shared_ptr<const Topology>& topology);
  void measure(const LiveMesh& live);
  void draw_sizes(const PanelContext& context) const;
  static void draw_markers(const PanelContext& context);

  Counts counts_;
  Box<3> extents_;           // z = 0 in the plane
  std::uint64_t shape_ = 0;  // that the extents are of
  std::uint64_t generation_ = 0;
};

}  // namespace winslow::gui
