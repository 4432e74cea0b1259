#include "gui/shell/workbench/panel_list.h"

#include "gui/panels/panels.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// One panel for the user, with different implementations for plane and volume meshes.
DrawPanel node_panel() {
  return [plane = vcv_panel(), volume = sphere_panel()](const PanelContext& context) {
    (context.session.kind() == MeshKind::volume ? volume : plane)(context);
  };
}

}  // namespace

PanelRegistry make_panels() {
  PanelRegistry r;
  r.add({"menu", "Menu", Region::menu, draw_menu_bar});
  r.add({"toolbar", "Toolbar", Region::toolbar, draw_toolbar});
  r.add({"status", "Status", Region::status, draw_status});
  r.add({"zone", "Zone", Region::left, draw_zone});
  r.add({"markers", "Markers", Region::left, markers_panel()});
  r.add({"cuts", "Cuts", Region::left, cuts_panel(), {}, volume_meshes});
  // Hidden for a surface mesh, which keeps its shape; the menus explain this.
  r.add({"motion", "Move the selection", Region::left, motion_panel(), {}, movable_meshes});
  r.add({"shape", "Shape", Region::left, shape_panel(), {}, movable_meshes});
  r.add({"layers",
         "Layers",
         Region::left,
         layers_panel(),
         {},
         movable_meshes,
         plane_meshes,
         "Layers: those of selected walls can be held, by the menu Layers."});
  r.add({"solver", "Solver", Region::left, solver_panel()});
  r.add({"mesh", "Mesh", Region::left, mesh_panel()});
  r.add({"measures", "Areas and volumes", Region::left, measures_panel(), {}, meshes_in_space});
  r.add({"quality", "Quality", Region::right, draw_quality, SideTab::quality});
  r.add(
      {"deviation", "Shape", Region::right, draw_deviation, SideTab::quality, {MeshKind::surface}});
  r.add({"walls", "Walls", Region::right, draw_walls, SideTab::quality});
  r.add({"go_to", "Go to", Region::right, go_to_panel(), SideTab::quality});
  r.add({"worst", "Worst elements", Region::right, worst_panel(), SideTab::quality});
  r.add({"isolate", "Isolate", Region::right, draw_isolation, SideTab::quality});
  r.add({"view", "View", Region::right, draw_view, SideTab::view});
  r.add({"vcv", "Virtual control volume", Region::right, node_panel(), SideTab::vcv});
  r.add({"history", "History", Region::right, history_panel(), SideTab::history});
  r.add({"convergence", "Convergence", Region::plot, convergence_panel()});
  r.add({"banner", "Banner", Region::banner, draw_banner});
  r.add({"demo", "Guided demo", Region::demo, draw_demo});
  r.add({"recording", "Recording", Region::recording, draw_recording});
  return r;
}

void PanelRegistry::add(RegisteredPanel panel) {
  if (std::ranges::any_of(panels_, [&](const auto& other) { return other.id == panel.id; }))
    throw std::logic_error("two panels \"" + panel.id + "\"");
  panels_.push_back(std::move(panel));
}

void PanelRegistry::draw(Region region, const PanelContext& context, MeshKind mesh) const {
  constexpr std::array<const char*, 3> kinds{"plane", "surface", "volume"};
  for (const RegisteredPanel& panel : panels_) {
    if (panel.region != region || !panel.shown_for.contains(mesh)) continue;
    if (panel.tab && panel.tab != context.view.side_tab) continue;
    if (panel.serves.contains(mesh))
      panel.draw(context);
    else if (!panel.instead.empty())
      ui::text_wrapped(panel.instead, palette().text_dim);
    else
      ui::text_dim(panel.title + ": not for " + kinds[static_cast<std::size_t>(mesh)] + " meshes.");
  }
}

}  // namespace winslow::gui
