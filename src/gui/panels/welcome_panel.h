#pragma once

#include "gui/demos/demo.h"
#include "gui/files/assets.h"
#include "gui/files/recent_files.h"
#include "gui/files/thumbnails.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// The welcome page: recent files, the bundled meshes, the paper's cases as guided demos. Fills the
/// viewport while no mesh is open, or on request.
class WelcomePanel {
 public:
  static constexpr float card_width = 190, card_gap = 10;
  /// Size of the page at scale 1; the height includes recent files.
  static constexpr float page_width = 790, page_height = 672;

  void draw(const PanelContext& context);

  /// Shows or hides the page over the open mesh.
  void toggle() { wanted_ = !wanted_; }
  void close() { wanted_ = false; }
  bool wanted() const { return wanted_; }
  /// Pictures are still being made.
  bool busy() const { return thumbnails_.busy(); }
  const Thumbnails& thumbnails() const { return thumbnails_; }

 private:
  void draw_bundled(const PanelContext& context);
  bool draw_card(const PanelContext& context, const BundledMesh& mesh, float width, float height);
  void draw_demos(const PanelContext& context);
  bool draw_demo(const PanelContext& context, const Demo& demo, float width, float height);

  bool wanted_ = false;
  Thumbnails thumbnails_;
};

}  // namespace winslow::gui
