#pragma once

#include "core/layers/layer_spacing.h"
#include "core/layers/layer_stack.h"
#include "gui/menu/panel_context.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/plot_frame.h"

namespace winslow::gui {

/// The labels' share of a row in the panel of layers.
constexpr float layer_label_share = 0.46f;

/// A row for a number; typed input is accepted once it is finite.
inline void layer_field(const char* id, const char* label, double& value, const char* tip) {
  ui::row(label, tip, layer_label_share);
  double typed = value;
  if (ui::number(id, typed, tip) && std::isfinite(typed)) value = typed;
}

/// Fields for the part of a wall's markers that gets layers.
class PartForm {
 public:
  /// names: the markers, whose bounding box is the initial value.
  void draw(const PanelContext& context, const std::vector<std::string>& names);
  /// The values of the fields.
  WallPart part() const { return only_ ? part_ : WallPart{}; }
  /// Sets the fields.
  void set(const WallPart& part);

 private:
  WallPart part_;
  bool only_ = false;
};

/// Fields for the heights of layers at a wall.
class SpacingForm {
 public:
  void draw();
  /// The values of the fields.
  LayerSpacing spacing() const;
  /// Sets the fields.
  void set(const LayerSpacing& spacing);
  /// Heights for the values of the fields; none while these are invalid.
  std::vector<double> heights() const;

 private:
  void draw_first();
  void draw_total();

  LayerSpacing spacing_;
  double total_ = 0.1;
  bool has_total_ = false, from_y_plus_ = false;
  double y_plus_ = 1, reynolds_ = 1e6, length_ = 1;
};

/// The quality of the layers of the mesh on screen.
class LayerResult {
 public:
  /// Draws nothing while the mesh has no layers.
  void draw(const PanelContext& context);

 private:
  void measure(const PanelContext& context);
  void draw_cut_columns(const PanelContext& context);

  // The measures are valid for this stack, shape and selection.
  std::shared_ptr<const LayerStack> stack_;
  std::uint64_t shape_ = 0;
  std::vector<Index> selection_;
  LayerMeasures measures_;
  ui::LayerHeights heights_;
};

}  // namespace winslow::gui
