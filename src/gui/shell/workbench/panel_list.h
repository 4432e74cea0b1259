#pragma once

#include "gui/document/session/session.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Where panels stand in the studio's window.
enum class Region { menu, toolbar, status, left, right, plot, banner, demo, recording };

struct RegisteredPanel {
  std::string id;     ///< no other panel has it
  std::string title;  ///< as the user is told of it
  Region region = Region::left;
  DrawPanel draw;
  std::optional<SideTab> tab = {};   ///< that is to be open; none: it has none
  MeshKinds shown_for = all_meshes;  ///< nothing is said of it while another mesh is open
  MeshKinds serves = all_meshes;     ///< a line says that it does not serve another mesh
};

/// The panels of the studio, in the order in which they stand in their regions.
class PanelRegistry {
 public:
  /// Throws std::logic_error if another panel has this id.
  void add(RegisteredPanel panel);
  /// Draws the panels of a region into the current ImGui window. mesh: of the open mesh, or what
  /// could be opened.
  void draw(Region region, const PanelContext& context, MeshKind mesh) const;
  const std::vector<RegisteredPanel>& panels() const { return panels_; }

 private:
  std::vector<RegisteredPanel> panels_;
};

/// Every panel that has a place of its own in the window.
///
/// TO ADD A PANEL, add a line to the list in panel_list.cpp.
PanelRegistry make_panels();

}  // namespace winslow::gui
