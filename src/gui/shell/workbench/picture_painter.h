#pragma once

#include "gui/menu/panel_context.h"
#include "gui/picture/capture/capture.h"
#include "gui/shell/workbench/regions.h"
#include "gui/shell/workbench/viewport_pane.h"

namespace winslow::gui {

/// Draws the window, and pictures of another size or of the mesh alone. Pictures have a separate
/// layout and do not change that of the window.
class PicturePainter : public PictureSource {
 public:
  /// The content of the window; all references must outlive the painter.
  struct Shown {
    Session& session;
    PanelContext context;
    const Camera& view;        ///< of plane meshes
    const SpaceCamera& space;  ///< of volume meshes
    WindowFrame& window;
    Regions& regions;
    ViewportPane& pane;
  };
  explicit PicturePainter(const Shown& shown) : shown_(shown) {}
  ~PicturePainter() override;

  /// Draws the window's frame last laid out into the bound framebuffer.
  void paint_window();
  /// Draws the window's frame off-screen.
  Image picture() override;
  Image picture(const PictureSpec& spec) override;
  Image picture_of(const Coordinates& nodes, const PictureSpec& spec) override;
  ScreenVector picture_extent(const PictureSpec& spec) const override;
  VectorFigure figure(bool legend) const override;

  /// Call it between frames. Frees the data of the last picture after a while without pictures.
  void forget_idle(double seconds);

 private:
  VectorFigure space_figure(bool legend) const;
  Image raster_of(SpaceCamera camera, double finest) const;
  struct Picture;
  std::unique_ptr<Picture> begin(const PictureSpec& spec, float scale);
  void lay_out(Picture& picture, const Bounds& visible);
  void draw_space_tile(const Picture& picture, const ScreenBox& tile, bool transparent, int height);
  Image paint_tiles(Picture& picture, bool transparent);
  void end(std::unique_ptr<Picture> picture, unsigned framebuffer);

  Shown shown_;
  std::unique_ptr<WindowFrame> last_;  // of the last picture, for reuse at the same size
  double age_ = 0;                     // seconds since the last picture
};

}  // namespace winslow::gui
