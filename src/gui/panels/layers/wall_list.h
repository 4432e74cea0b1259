#pragma once

#include <string>
#include <vector>

#include "gui/panels/panel.h"

namespace winslow::gui {

/// "main, flap".
std::string marker_list(const std::vector<std::string>& names);

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

}  // namespace winslow::gui
