#include "gui/shell/workbench/panel_list.h"

#include <stdexcept>

#include "gui/panels/bars.h"
#include "gui/panels/convergence_panel.h"
#include "gui/panels/element_panels.h"
#include "gui/panels/history_panel.h"
#include "gui/panels/layers/layers_panel.h"
#include "gui/panels/markers_panel.h"
#include "gui/panels/menus.h"
#include "gui/panels/mesh_panel.h"
#include "gui/panels/message_panels.h"
#include "gui/panels/motion_panel.h"
#include "gui/panels/picture_dialogs.h"
#include "gui/panels/quality_panel.h"
#include "gui/panels/shape_panel.h"
#include "gui/panels/solver_panel.h"
#include "gui/panels/space/cuts_panel.h"
#include "gui/panels/space/measures_panel.h"
#include "gui/panels/vcv/sphere_panel.h"
#include "gui/panels/vcv/vcv_panel.h"
#include "gui/panels/view_panel.h"
#include "gui/panels/welcome_panel.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// One panel of the user's, which is another for a volume mesh.
template <class InPlane, class InSpace>
class OfEither : public Panel {
 public:
  void draw(const PanelContext& context) override {
    if (context.session.kind() == MeshKind::volume)
      in_space_.draw(context);
    else
      in_plane_.draw(context);
  }

 private:
  InPlane in_plane_;
  InSpace in_space_;
};

template <class P>
RegisteredPanel entry(const char* id, const char* title, Region region, MeshKinds serves) {
  return {id, title, region, serves, std::make_unique<P>(), {}};
}

/// A panel of one tab of the column on the right.
template <class P>
RegisteredPanel in_tab(SideTab tab, const char* id, const char* title, MeshKinds serves) {
  return {
      id, title, Region::right, serves, std::make_unique<P>(), [tab](const PanelContext& context) {
        return context.view.side_tab == tab;
      }};
}

/// Of a surface mesh, which keeps its shape, nothing is said: the menus say why.
RegisteredPanel of_movable(RegisteredPanel panel) {
  panel.shown = [](const PanelContext& context) {
    return movable_meshes.contains(context.session.kind());
  };
  return panel;
}

}  // namespace

PanelRegistry make_panels() {
  PanelRegistry r;
  r.add(entry<MenuBar>("menu", "Menu", Region::menu, all_meshes));
  r.add(entry<Toolbar>("toolbar", "Toolbar", Region::toolbar, all_meshes));
  r.add(entry<StatusBar>("status", "Status", Region::status, all_meshes));
  r.add(entry<ZonePanel>("zone", "Zone", Region::left, all_meshes));
  r.add(entry<MarkersPanel>("markers", "Markers", Region::left, all_meshes));
  r.add({"cuts", "Cuts", Region::left, all_meshes, std::make_unique<CutsPanel>(),
         [](const PanelContext& context) { return context.session.kind() == MeshKind::volume; }});
  r.add(
      of_movable(entry<MotionPanel>("motion", "Move the selection", Region::left, movable_meshes)));
  r.add(of_movable(entry<ShapePanel>("shape", "Shape", Region::left, movable_meshes)));
  r.add(of_movable(entry<LayersPanel>("layers", "Layers", Region::left, plane_meshes)));
  r.add(entry<SolverPanel>("solver", "Solver", Region::left, all_meshes));
  r.add(entry<MeshPanel>("mesh", "Mesh", Region::left, all_meshes));
  r.add({"measures", "Areas and volumes", Region::left, all_meshes,
         std::make_unique<MeasuresPanel>(),
         [](const PanelContext& context) { return context.session.in_space(); }});
  r.add(in_tab<QualityPanel>(SideTab::quality, "quality", "Quality", all_meshes));
  r.add(in_tab<DeviationPanel>(SideTab::quality, "deviation", "Shape", all_meshes));
  r.add(in_tab<WallPanel>(SideTab::quality, "walls", "Walls", all_meshes));
  r.add(in_tab<GoToPanel>(SideTab::quality, "go_to", "Go to", all_meshes));
  r.add(in_tab<WorstPanel>(SideTab::quality, "worst", "Worst elements", all_meshes));
  r.add(in_tab<IsolatePanel>(SideTab::quality, "isolate", "Isolate", all_meshes));
  r.add(in_tab<ViewPanel>(SideTab::view, "view", "View", all_meshes));
  r.add(in_tab<OfEither<VcvPanel, SpherePanel>>(SideTab::vcv, "vcv", "Virtual control volume",
                                                all_meshes));
  r.add(in_tab<HistoryPanel>(SideTab::history, "history", "History", all_meshes));
  r.add(entry<ConvergencePanel>("convergence", "Convergence", Region::plot, all_meshes));
  r.add(entry<BannerPanel>("banner", "Banner", Region::banner, all_meshes));
  r.add(entry<DemoPanel>("demo", "Guided demo", Region::demo, all_meshes));
  r.add(entry<RecordingPanel>("recording", "Recording", Region::recording, all_meshes));
  return r;
}

namespace {

const char* name_of(MeshKind kind) {
  switch (kind) {
    case MeshKind::plane:
      return "plane";
    case MeshKind::surface:
      return "surface";
    case MeshKind::volume:
      return "volume";
  }
  return "";
}

}  // namespace

void PanelRegistry::add(RegisteredPanel panel) {
  if (std::ranges::any_of(panels_, [&](const auto& other) { return other.id == panel.id; }))
    throw std::logic_error("two panels \"" + panel.id + "\"");
  panels_.push_back(std::move(panel));
}

void PanelRegistry::draw(Region region, const PanelContext& context, MeshKind mesh) const {
  for (const RegisteredPanel& entry : panels_) {
    if (entry.region != region || (entry.shown && !entry.shown(context))) continue;
    if (entry.serves.contains(mesh))
      entry.panel->draw(context);
    else
      ui::text_dim(entry.title + ": not for " + name_of(mesh) + " meshes.");
  }
}

}  // namespace winslow::gui
