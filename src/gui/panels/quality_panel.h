#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The quality table as in the paper: minimum, average and maximum of each metric, before and now
/// side by side.
class QualityPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_choice(const PanelContext& context);
};

/// What a flow solver cares for at the walls of bodies, before and now. Nothing for a mesh without
/// walls.
class WallPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

/// How far a surface mesh is from what it was when it was opened, and the volume that it encloses.
/// Nothing for other meshes.
class DeviationPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
