#pragma once

#include <imgui.h>

#include "gui/menu/panel_context.h"
#include "gui/panels/layout.h"
#include "gui/panels/welcome_panel.h"
#include "gui/shell/workbench/panel_list.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/ui_layer.h"

namespace winslow::gui {

/// The interface of a framebuffer: that of the window, or of a picture with another size.
struct WindowFrame {
  explicit WindowFrame(float scale) : ui(scale) {}

  UiLayer ui;
  Layout layout;
  int width = 1, height = 1;  ///< of the framebuffer, pixels
};

/// Divides a window into regions and draws the panels in them.
class Regions {
 public:
  Regions();

  /// Draws the menu bar and divides the rest of the framebuffer.
  void draw_menu(const PanelContext& context, WindowFrame& frame) const;
  /// Draws the toolbar, the status bar and the columns beside the mesh.
  void draw(const PanelContext& context, const Layout& layout) const;
  /// Handles the splitters between the regions. Returns the pixels by which the divider between two
  /// meshes was dragged; none without a divider.
  std::optional<float> drag_splitters(const PanelContext& context, Layout& layout) const;

  /// Cards drawn over the mesh: all in the window, those on the mesh in a picture of it, none in a
  /// picture of the mesh alone.
  enum class Cards { all, of_the_mesh, none };
  /// Draws those cards, or the welcome page. area: of the mesh.
  void draw_over_mesh(const PanelContext& context, const Area& area, Cards cards);

  /// True while the welcome page replaces the mesh.
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
