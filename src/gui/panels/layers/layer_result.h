#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/layers/layer_measures.h"
#include "gui/panels/panel.h"
#include "gui/widgets/height_plot.h"

namespace winslow::gui {

/// How the layers of the mesh on screen came out.
class LayerResult {
 public:
  /// Nothing while the mesh has no layers.
  void draw(const PanelContext& context);

 private:
  void measure(const PanelContext& context);
  void draw_cut_columns(const PanelContext& context);

  // Measured of this stack when the mesh had this shape and these markers were selected.
  std::shared_ptr<const LayerStack> stack_;
  std::uint64_t shape_ = 0;
  std::vector<Index> selection_;
  LayerMeasures measures_;
  ui::LayerHeights heights_;
};

}  // namespace winslow::gui
