#pragma once

#include <vector>

#include "gui/panels/panel.h"

namespace winslow::gui {

/// Single columns that are set by hand, over the rules for corners and gaps.
class ColumnList {
 public:
  /// A list in a fold, and fields for the one chosen. A node is added by inspecting it.
  void draw(const PanelContext& context, const std::vector<LayerWall>& walls);
  /// Those that say something, on these walls.
  std::vector<ColumnOverride> on(const Topology& topology,
                                 const std::vector<LayerWall>& walls) const;
  void clear() { columns_.clear(); }

 private:
  void draw_add(const PanelContext& context, const std::vector<LayerWall>& walls);
  void draw_fields();

  std::vector<ColumnOverride> columns_;
  std::size_t chosen_ = 0;
  double thickness_ = 0.01;  // in the field, while the column has none of its own
};

}  // namespace winslow::gui
