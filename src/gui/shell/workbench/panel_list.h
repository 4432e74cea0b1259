#pragma once

#include "gui/document/session/session.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// The regions of the studio's window that contain panels.
enum class Region { menu, toolbar, status, left, right, plot, banner, demo, recording };

struct RegisteredPanel {
  std::string id;     ///< unique
  std::string title;  ///< shown to the user
  Region region = Region::left;
  DrawPanel draw;
  std::optional<SideTab> tab = {};   ///< tab that contains the panel; none: in no tab
  MeshKinds shown_for = all_meshes;  ///< hidden while another kind of mesh is open
  MeshKinds serves = all_meshes;     ///< for other kinds, words take the place of the panel
  std::string instead = {};          ///< these words; empty: that such meshes are not supported
};

/// The panels of the studio, in their order within the regions.
class PanelRegistry {
 public:
  /// Throws std::logic_error if another panel has this id.
  void add(RegisteredPanel panel);
  /// Draws the panels of a region into the current ImGui window. mesh: kind of the open mesh, or of
  /// a mesh that can be opened.
  void draw(Region region, const PanelContext& context, MeshKind mesh) const;
  const std::vector<RegisteredPanel>& panels() const { return panels_; }

 private:
  std::vector<RegisteredPanel> panels_;
};

/// All panels with a place in the window.
///
/// TO ADD A PANEL, add a line to the list in panel_list.cpp.
PanelRegistry make_panels();

}  // namespace winslow::gui
