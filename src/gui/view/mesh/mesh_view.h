#pragma once

#include "gui/document/session/session.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/view/mesh/mesh_layer.h"
#include "gui/view/mesh/volume_view.h"
#include "gui/widgets/legend.h"

namespace winslow::gui {

/// Keeps the picture in step with the session: the mesh, its colours and markers, and the state
/// before where the two are compared. Uploads only what changed. volume() draws meshes in space;
/// the functions about the picture serve both kinds of mesh.
class MeshView {
 public:
  void update(const Session& session, const BeforeMesh& before, const ViewOptions& view,
              float scale);
  /// Draws backdrop and mesh into the bound framebuffer, `height` pixels high. whole: the view of
  /// which the camera sees a part, over which the backdrop extends; null: no backdrop.
  void draw(const Camera& camera, const Camera* whole, int height);
  /// The same with the backdrop, for the frames of a window. The picture of a large mesh is kept
  /// and redrawn only when it changes. A frame in which only the interface changes, such as a
  /// progress bar or a menu under the mouse, then costs as little as one without a mesh.
  void draw_kept(const Camera& camera, int width, int height);
  /// Discards the kept picture, so that the next draw_kept() redraws it.
  void forget_picture() {
    kept_.forget();
    volume_.forget_picture();
  }
  VolumeView& volume() { return volume_; }
  const VolumeView& volume() const { return volume_; }
  /// A mesh is on screen, perhaps still without its colours.
  bool has_mesh() const { return shown() != nullptr; }
  /// The mesh on screen has its colours, too.
  bool has_colors() const { return has_mesh() && legend().has_value(); }
  /// Sets the x coordinate, in mesh units, that separates the mesh before from the mesh now, side
  /// by side.
  void set_divider(double x) { divider_ = x; }
  /// Draws the present mesh alone with the camera of a magnifier.
  void draw_magnified(const Camera& camera, const Camera& whole, int height);
  /// The mesh now on screen, if any.
  const ShownMesh* shown() const {
    if (in_space_) return volume_.shown();
    return has_mesh_ && now_.shown() ? &*now_.shown() : nullptr;
  }
  /// Adopts what the background has prepared. True if the picture changes.
  bool poll();
  bool busy() const { return in_space_ ? volume_.busy() : now_.busy() || before_.busy(); }
  /// Legend of the colours now shown; none if elements are plain.
  const std::optional<Legend>& legend() const {
    return in_space_ ? volume_.legend() : now_.legend();
  }

 private:
  void update_markers(const Session& session, const ViewOptions& view, float scale);
  void draw_split(const Camera& camera, int height);
  /// All that the kept picture depends on.
  struct PictureKey {
    Camera camera;
    int width = 0, height = 0;
    MeshStyle style, ghost;
    BackdropColors backdrop;
    Comparison comparison = Comparison::none;
    double divider = 0;
    std::uint64_t now = 0, before = 0;  // revisions
    std::vector<MeshRenderer::MarkerStyle> markers;

    bool operator==(const PictureKey&) const = default;
  };
  PictureKey picture_key(const Camera& camera, int width, int height);

  MeshLayer now_, before_;
  VolumeView volume_;
  bool in_space_ = false;
  MeshStyle style_;
  MeshStyle ghost_;
  BackdropColors backdrop_;
  Comparison comparison_ = Comparison::none;
  double divider_ = 0;
  bool has_mesh_ = false;
  std::vector<MeshRenderer::MarkerStyle> markers_;
  KeptPicture<PictureKey> kept_;
};

}  // namespace winslow::gui
