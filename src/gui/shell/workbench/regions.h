#pragma once

#include <imgui.h>

#include "gui/menu/panel_context.h"
#include "gui/panels/layout.h"
#include "gui/panels/welcome_panel.h"
#include "gui/shell/workbench/panel_list.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/ui_layer.h"

namespace winslow::gui {

/// The interface of a framebuffer: of the window, or of a picture with a size of its own.
struct WindowFrame {
  explicit WindowFrame(float scale) : ui(scale) {}

  UiLayer ui;
  Layout layout;
  int width = 1, height = 1;  ///< of the framebuffer, pixels
};

/// The regions into which a window is divided, and the panels that stand in them.
class Regions {
 public:
  Regions();

  /// The bar of menus; divides what is left of the framebuffer.
  void draw_menu(const PanelContext& context, WindowFrame& frame) const;
  /// Toolbar, status and the columns beside the mesh.
  void draw(const PanelContext& context, const Layout& layout) const;
  /// The strips between them that are dragged. Returns by how many pixels the divider between two
  /// meshes was; none if there is no divider.
  std::optional<float> drag_splitters(const PanelContext& context, Layout& layout) const;

  /// Cards that lie over the mesh: in the window, in a picture of it, in one of the mesh alone.
  enum class Cards { all, of_the_mesh, none };
  /// Those cards, or the page of where to begin. area: of the mesh.
  void draw_over_mesh(const PanelContext& context, const Area& area, Cards cards);

  /// The page of where to begin is in the mesh's place.
  bool shows_welcome(const Session& session) const;
  WelcomePanel& welcome() { return welcome_; }
  const WelcomePanel& welcome() const { return welcome_; }
  const PanelRegistry& panels() const { return panels_; }

 private:
  void draw_panels(const PanelContext& context, Region region) const;
  void draw_recording(const PanelContext& context, const Area& area) const;
  void draw_demo_card(const PanelContext& context, const Area& area) const;

  PanelRegistry panels_;
  WelcomePanel welcome_;
};

}  // namespace winslow::gui
