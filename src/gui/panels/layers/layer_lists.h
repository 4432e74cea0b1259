#pragma once

#include "gui/menu/panel_context.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Walls that have settings of their own. While it is empty, the markers selected are the wall.
class WallList {
 public:
  const std::vector<LayerWall>& walls() const { return walls_; }
  /// The wall of just these markers; null: there is none.
  LayerWall* find(const std::vector<std::string>& markers);
  /// Adds a wall. A marker is in one wall only: those that had it before lose it.
  void add(LayerWall wall);
  void clear() { walls_.clear(); }

  /// A row for each wall: a click selects its markers, a cross takes it out.
  void draw(const PanelContext& context);

 private:
  bool draw_row(const PanelContext& context, std::size_t k);

  std::vector<LayerWall> walls_;
};

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
