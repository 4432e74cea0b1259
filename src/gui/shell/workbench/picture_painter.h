#pragma once

#include "gui/menu/panel_context.h"
#include "gui/picture/capture/capture.h"
#include "gui/shell/workbench/regions.h"
#include "gui/shell/workbench/viewport_pane.h"

namespace winslow::gui {

/// Draws the window, and pictures of it that have another size or show the mesh alone. Those are
/// laid out in a frame of their own: the window's stays as it is.
class PicturePainter : public PictureSource {
 public:
  /// What the window shows; all of it outlives the painter.
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
  /// The same, off-screen.
  Image picture() override;
  Image picture(const PictureSpec& spec) override;
  Image picture_of(const Coordinates& nodes, const PictureSpec& spec) override;
  ScreenVector picture_extent(const PictureSpec& spec) const override;
  VectorFigure figure(bool legend) const override;

  /// Between frames. Frees what the last picture needed once none has been asked for in a while.
  void forget_idle(double seconds);

 private:
  VectorFigure space_figure(bool legend) const;
  Image raster_of(SpaceCamera camera) const;
  struct Picture;
  std::unique_ptr<Picture> begin(const PictureSpec& spec, float scale);
  void lay_out(Picture& picture, const Bounds& visible);
  void draw_space_tile(const Picture& picture, const ScreenBox& tile, bool transparent, int height);
  Image paint_tiles(Picture& picture, bool transparent);
  void end(std::unique_ptr<Picture> picture, unsigned framebuffer);

  Shown shown_;
  std::unique_ptr<WindowFrame> last_;  // of the last picture: the next often has its size
  double age_ = 0;                     // seconds since the last picture
};

}  // namespace winslow::gui
