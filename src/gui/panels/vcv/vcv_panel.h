#pragma once

#include "core/inspect/nodal_view.h"
#include "gui/menu/panel_context.h"
#include "gui/panels/vcv/vcv_plot.h"

namespace winslow::gui {

/// One node: its star beside its virtual control volume, what the operator knows there, and the
/// means to change it.
class VcvPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_plot(const PanelContext& context, const NodalView& view);
  void draw_figures(const NodalView& view, const Theme& theme);
  void draw_neighbours(const PanelContext& context, const NodalView& view);
  void draw_edge_fields(const PanelContext& context, const NodalView& view);
  void draw_reset(const PanelContext& context, const NodalView& view);
  void draw_spread(const PanelContext& context, const NodalView& view);
  std::function<bool(Index)> within(const PanelContext& context, Index middle) const;
  const std::vector<Index>& spread_targets(const PanelContext& context, const NodalView& view);

  /// What the nodes depend on that a VCV is applied to.
  struct SpreadTo {
    std::uint64_t shape = 0;
    Index node = -1;
    std::size_t choice = 0;
    double radius = 0;
    std::vector<Index> pinned;
    bool operator==(const SpreadTo&) const = default;
  };

  VcvPlot plot_;
  int typed_node_ = 0;
  std::optional<Index> shown_;          // node that the state below belongs to
  std::optional<std::size_t> hovered_;  // neighbour, in the table
  std::size_t edge_ = 0;                // whose numbers are in the fields
  double angle_ = 0, length_ = 0;       // as typed
  bool typing_angle_ = false, typing_length_ = false;
  bool star_figures_ = false;  // the table shows the physical star
  std::size_t spread_to_ = 0;
  double radius_ = 0;
  SpreadTo spread_;  // that targets_ were found for: all nodes are gone through
  std::vector<Index> targets_;
};

}  // namespace winslow::gui
