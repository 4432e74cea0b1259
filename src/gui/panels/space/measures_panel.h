#pragma once

#include "core/inspect/space/surface_measures.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Areas and volumes of the open volume mesh: of all of it, of its markers, of the surface that is
/// selected and of the elements that are shown alone.
class MeasuresPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void measure(const Session& session);
  void draw_surface() const;
  void draw_selection(const PanelContext& context) const;
  void draw_markers(const PanelContext& context) const;

  // What the numbers are of.
  std::uint64_t generation_ = 0, shape_ = 0;
  std::vector<Index> selected_;
  bool known_ = false;
  double area_ = 0;  // of a surface mesh
  std::optional<double> encloses_;
  double volume_ = 0;
  std::vector<double> areas_;  // of markers
  SurfaceMeasures selection_;
};

}  // namespace winslow::gui
