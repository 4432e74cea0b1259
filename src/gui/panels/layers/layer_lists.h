#pragma once

#include "gui/menu/panel_context.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Walls with individual settings. While the list is empty, the selected markers are the wall.
class WallList {
 public:
  const std::vector<LayerWall>& walls() const { return walls_; }
  /// The wall of exactly these markers; null: none.
  LayerWall* find(const std::vector<std::string>& markers);
  /// Adds a wall. Each marker is in one wall only: it is removed from other walls.
  void add(LayerWall wall);
  void clear() { walls_.clear(); }

  /// Draws a row for each wall: a click selects its markers, a cross removes it.
  void draw(const PanelContext& context);

 private:
  bool draw_row(const PanelContext& context, std::size_t k);

  std::vector<LayerWall> walls_;
};

/// Settings of single columns, which override the rules for corners and gaps.
class ColumnList {
 public:
  /// Draws the list in a fold, and fields for the chosen column. The inspected node can be added.
  void draw(const PanelContext& context, const std::vector<LayerWall>& walls);
  /// The non-default overrides on these walls.
  std::vector<ColumnOverride> on(const Topology& topology,
                                 const std::vector<LayerWall>& walls) const;
  void clear() { columns_.clear(); }

 private:
  void draw_add(const PanelContext& context, const std::vector<LayerWall>& walls);
  void draw_fields();

  std::vector<ColumnOverride> columns_;
  std::size_t chosen_ = 0;
  double thickness_ = 0.01;  // in the field, while the column does not set one
};

}  // namespace winslow::gui
