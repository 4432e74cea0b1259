#include "gui/panels/layers/part_form.h"

#include <algorithm>
#include <limits>

#include "gui/panels/layers/fields.h"

namespace winslow::gui {

namespace {

/// The box around markers.
WallPart box_of(const PanelContext& context, const std::vector<std::string>& names) {
  constexpr double far = std::numeric_limits<double>::infinity();
  WallPart box{far, -far, far, -far};
  for (const Index node : context.topology()->markers().nodes_of(names)) {
    const Vec2 p = context.session.coordinates().xy(node);
    box = {std::min(box.xmin, p.x()), std::max(box.xmax, p.x()), std::min(box.ymin, p.y()),
           std::max(box.ymax, p.y())};
  }
  return box;
}

}  // namespace

void PartForm::draw(const PanelContext& context, const std::vector<std::string>& names) {
  const bool changed =
      ui::checkbox("layers/part", "Only part of the wall", only_,
                   "Layers at those edges only that have both ends in a box. They run out at its "
                   "ends, or stand on the boundary that follows there.");
  if (!only_) return;
  if (changed) part_ = box_of(context, names);
  layer_field("layers/xmin", "From x", part_.xmin, "Left end of the box, in units of the mesh.");
  layer_field("layers/xmax", "To x", part_.xmax, "Right end of the box, in units of the mesh.");
  layer_field("layers/ymin", "From y", part_.ymin, "Lower end of the box, in units of the mesh.");
  layer_field("layers/ymax", "To y", part_.ymax, "Upper end of the box, in units of the mesh.");
}

void PartForm::set(const WallPart& part) {
  only_ = part != WallPart{};
  if (only_) part_ = part;
}

}  // namespace winslow::gui
