#pragma once

#include "gui/document/session/session.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/space/space_renderer.h"
#include "gui/render/space/space_scene.h"
#include "gui/render/space/space_view.h"
#include "gui/settings/view_options.h"
#include "gui/view/mesh/mesh_layer.h"
#include "gui/view/mesh/volume_layer.h"

namespace winslow::gui {

/// Keeps the picture of a volume mesh in step with the session; uploads only what changed.
class VolumeView {
 public:
  void update(const Session& session, const BeforeMesh& before, const ViewOptions& view,
              float scale);
  void clear();
  /// Sets the elements to show through what hides them, from the next update() on.
  void set_worst(std::vector<Index> worst) { worst_ = std::move(worst); }
  /// Draws into the bound framebuffer, `height` pixels high; in a comparison side by side the mesh
  /// before, too. camera: of the mesh now; side_by_side() gives the place of each. whole: the part
  /// of the framebuffer over which the backdrop extends; null: no backdrop.
  void draw(const SpaceCamera& camera, const ScreenBox* whole, int height);
  /// Draws the mesh now alone, without the backdrop.
  void draw_alone(const SpaceCamera& camera, int height) {
    if (layer_.scenes()) draw_now(camera, height);
  }
  /// Draws mesh and backdrop from a kept picture, which is redrawn only when it changes.
  void draw_kept(const SpaceCamera& camera, int width, int height);
  void forget_picture() { kept_.forget(); }

  bool poll();
  bool busy() const { return layer_.busy() || (compares() && before_layer_.busy()); }
  const ShownMesh* shown() const { return layer_.scenes() ? &layer_.scenes()->shown : nullptr; }
  const std::optional<Legend>& legend() const;
  /// The mesh in the picture; null before the first one.
  const Mesh* mesh() const { return layer_.scenes() ? layer_.scenes()->of.mesh.get() : nullptr; }
  /// The visible point of the mesh at a place of the screen; none: nothing is drawn there.
  std::optional<SpaceHit> pick(const View& view, const ScreenPoint& at) const;
  /// Grows with every new picture.
  std::uint64_t revision() const { return layer_.revision(); }
  /// Scenes of the mesh before; null if it is not compared.
  const VolumeScenes* before_scenes() const { return before_layer_.scenes(); }
  /// Scenes of the picture; null before the first one. Tests see here which parts are rebuilt.
  const VolumeScenes* scenes() const { return layer_.scenes(); }

 private:
  VolumeWish wish_of(const Session& session, const ViewOptions& view, float scale);
  void compare(const Session& session, const BeforeMesh& before, VolumeWish wish);
  bool compares() const { return comparison_ != Comparison::none; }
  void draw_now(const SpaceCamera& camera, int height);
  void draw_before(SpaceCamera camera, const ScreenBox& whole, int height);
  void choose_tints(const Session& session);

  struct PictureKey {
    SpaceCamera camera;
    int width = 0, height = 0;
    BackdropColors backdrop;
    std::uint64_t revision = 0, before = 0;
    std::vector<Rgba> tints;
    Comparison comparison = Comparison::none;

    bool operator==(const PictureKey&) const = default;
  };

  VolumeLayer layer_;
  SpaceRenderer renderer_;
  std::uint64_t drawn_ = 0;  // revision of the layer held by the renderer
  // The mesh before: a ghost over the mesh now, or beside it.
  VolumeLayer before_layer_;
  SpaceRenderer before_renderer_;
  std::uint64_t before_drawn_ = 0, ghost_drawn_ = 0;
  std::shared_ptr<const Mesh> before_mesh_;
  std::uint64_t before_generation_ = 0, before_shape_ = 0;
  Comparison comparison_ = Comparison::none;
  double divider_ = 0.5;
  std::shared_ptr<const Mesh> mesh_;
  std::uint64_t generation_ = 0, shape_ = 0;  // of mesh_
  std::shared_ptr<const QualityMonitor::Measured> measured_;
  BackdropColors backdrop_;
  std::vector<Rgba> tints_;
  std::vector<Index> worst_;
  KeptPicture<PictureKey> kept_;
};

}  // namespace winslow::gui
