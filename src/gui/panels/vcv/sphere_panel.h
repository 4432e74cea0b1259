#pragma once

#include "core/inspect/nodal_view.h"
#include "gui/menu/panel_context.h"
#include "gui/panels/vcv/sphere_plot.h"

namespace winslow::gui {

/// One node of a volume mesh: its star beside its virtual control volume on the sphere, what the
/// operator knows there, and the means to change it.
class SpherePanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
  const SpherePlot& plot() const { return plot_; }

 private:
  void follow_node(const PanelContext& context, Index node);
  void draw_plot(const PanelContext& context, const VolumeNodalView& view);
  void draw_turning(const PanelContext& context);
  void draw_kind(const PanelContext& context);
  void draw_hint(const VolumeNodalView& view);
  void draw_figures(const VolumeNodalView& view);
  void draw_tables(const Theme& theme, const VolumeNodalView& view);
  void draw_edges(const VolumeNodalView& view);
  void draw_faces(const VolumeNodalView& view);
  void draw_edge_fields(const PanelContext& context, const VolumeNodalView& view);
  void draw_reset(const PanelContext& context, const VolumeNodalView& view);
  void draw_spread(const PanelContext& context, const VolumeNodalView& view);

  SpherePlot plot_;
  bool large_ = false;
  int typed_node_ = 0;
  std::optional<Index> shown_;            // node that the state below belongs to
  std::optional<std::size_t> hovered_;    // neighbour
  std::optional<std::size_t> over_face_;  // triangle, in the table
  std::size_t edge_ = 0;                  // whose numbers are in the fields
  std::size_t table_ = 0;
  Vec3 direction_{0, 0, 1};  // as typed
  double length_ = 1;
  std::size_t spread_to_ = 0;  // which of the choices of "Apply to"
  double radius_ = 0;          // of the second of them; 0: none yet
  int typing_ = 0;             // frames for which the fields keep what was typed
};

}  // namespace winslow::gui
