#pragma once

#include <string>
#include <vector>

#include "core/layers/layer_wall.h"
#include "gui/panels/panel.h"

namespace winslow::gui {

/// Fields for the part of a wall's markers that is to have layers.
class PartForm {
 public:
  /// names: the markers, whose box the fields begin with.
  void draw(const PanelContext& context, const std::vector<std::string>& names);
  /// What the fields say.
  WallPart part() const { return only_ ? part_ : WallPart{}; }
  /// Puts another part into the fields.
  void set(const WallPart& part);

 private:
  WallPart part_;
  bool only_ = false;
};

}  // namespace winslow::gui
