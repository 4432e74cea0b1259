#pragma once

#include "core/search/box_tree.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// The planes that cut a volume mesh.
class CutsPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void measure(const LiveMesh& mesh);
  void draw_rows(const PanelContext& context, ViewOptions& view);
  void draw_place(ViewOptions& view, std::size_t k) const;
  static void draw_peel(const PanelContext& context, Peel& peel);
  void draw_buttons(const PanelContext& context, ViewOptions& view) const;

  Box<3> extents_;                            // of the mesh
  std::uint64_t generation_ = 0, shape_ = 0;  // that they are of
};

}  // namespace winslow::gui
