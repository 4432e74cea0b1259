#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "gui/document/session/session.h"
#include "gui/render/backdrop.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/space/space_camera.h"
#include "gui/render/space/space_pick.h"
#include "gui/render/space/space_renderer.h"
#include "gui/settings/view_options.h"
#include "gui/view/mesh/volume_layer.h"

namespace winslow::gui {

/// Keeps the picture of a volume mesh in step with the session; uploads only what changed.
class VolumeView {
 public:
  void update(const Session& session, const ViewOptions& view, float scale);
  void clear();
  /// Elements that are to be seen through what hides them, from the next update() on.
  void set_worst(std::vector<Index> worst) { worst_ = std::move(worst); }
  /// Draws into the bound framebuffer, `height` pixels high. whole: the part of the framebuffer
  /// over which the colours of the backdrop run; null: nothing lies behind.
  void draw(const SpaceCamera& camera, const ScreenBox* whole, int height);
  /// The same with the backdrop, of a picture that is kept and drawn anew only when it would be
  /// another.
  void draw_kept(const SpaceCamera& camera, int width, int height);
  void forget_picture() { kept_key_.reset(); }

  bool poll() { return layer_.poll(); }
  bool busy() const { return layer_.busy(); }
  const ShownMesh* shown() const { return layer_.scenes() ? &layer_.scenes()->shown : nullptr; }
  const std::optional<Legend>& legend() const;
  /// The mesh in the picture; null before the first one.
  const Mesh* mesh() const { return layer_.scenes() ? layer_.scenes()->of.mesh.get() : nullptr; }
  /// What is drawn at a place.
  std::optional<SpaceHit> pick(const View& view, const ScreenPoint& at) const;
  /// Parts that the picture has; for tests of what is made anew.
  const VolumeScenes* scenes() const { return layer_.scenes(); }

 private:
  VolumeWish wish_of(const Session& session, const ViewOptions& view, float scale);
  void choose_tints(const Session& session);

  struct PictureKey {
    SpaceCamera camera;
    int width = 0, height = 0;
    BackdropColors backdrop;
    std::uint64_t revision = 0;
    std::vector<Rgba> tints;

    bool operator==(const PictureKey&) const = default;
  };

  VolumeLayer layer_;
  SpaceRenderer renderer_;
  std::uint64_t drawn_ = 0;  // revision of the layer that the renderer has
  std::shared_ptr<const Mesh> mesh_;
  std::uint64_t generation_ = 0, shape_ = 0;  // of mesh_
  std::shared_ptr<const QualityMonitor::Measured> measured_;
  BackdropColors backdrop_;
  std::vector<Rgba> tints_;
  std::vector<Index> worst_;
  std::unique_ptr<FrameBuffer> kept_;
  std::optional<PictureKey> kept_key_;
};

}  // namespace winslow::gui
