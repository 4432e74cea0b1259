#pragma once

#include "core/inspect/space/plane_section.h"
#include "core/strategy/surface_shape.h"
#include "gui/base/background.h"
#include "gui/document/session/quality_watch.h"
#include "gui/document/session/session.h"
#include "gui/render/space/volume_scene.h"
#include "gui/settings/view_options.h"
#include "gui/view/mesh/mesh_layer.h"

namespace winslow::gui {

inline Plane plane_of(const CutPlane& cut) {
  return {Vec3(cut.point.data()), Vec3(cut.normal.data())};
}
/// normal: of any length but 0.
inline CutPlane cut_through(const Vec3& point, const Vec3& normal) {
  return {{point.x(), point.y(), point.z()}, {normal.x(), normal.y(), normal.z()}};
}

/// Request for a picture of a mesh in space: everything on which its scene depends.
struct VolumeWish {
  std::uint64_t generation = 0, shape = 0;
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const VolumeBoundary> boundary;
  /// Values to colour by; null: plain elements, or none measured yet.
  std::shared_ptr<const QualityMonitor::Measured> measured;
  ColorChoice colors;
  Isolation isolation;
  std::vector<CutPlane> cuts;  ///< those that are switched on
  Peel peel;                   ///< if it is switched on and its marker exists
  bool crinkle = false;
  bool mark_inverted = true;
  std::vector<Index> worst;  ///< elements shown through what hides them
  bool surfaces = true, edges = true;
  std::vector<MarkerShow> markers;
  std::vector<float> opacity;
  std::vector<Rgb> marker_colors;
  std::vector<Rgb> border_colors;               ///< of the markers of a surface mesh
  double feature_angle = 40;                    ///< degrees; see VolumeLook
  std::shared_ptr<const SurfaceShape> surface;  ///< of a surface mesh: its correct side
  VolumeStyle style;
  bool ghost = false;  ///< the bodies alone, as lines

  bool operator==(const VolumeWish&) const = default;
};

/// A picture of a mesh in space, ready to be drawn. Unchanged parts are shared with the previous
/// picture.
struct VolumeScenes {
  VolumeWish of;
  ShownMesh shown;
  std::vector<std::shared_ptr<const SpaceScene>> parts;
  std::vector<Plane> planes;
  std::optional<Legend> legend;
  struct Memory;
  std::shared_ptr<const Memory> memory;  ///< intermediate results, for reuse in the next picture
};

/// Builds the scenes of a mesh in space, those of a large one in the background. Until they are
/// ready, the previous picture stays.
class VolumeLayer {
 public:
  void want(VolumeWish wish);
  /// Adopts what the background has made. True if the picture changes.
  bool poll();
  /// The picture does not yet fulfil the last wish.
  bool busy() const { return worker_.busy() || waiting_.has_value(); }
  void clear();

  /// Null before the first picture of a mesh.
  const VolumeScenes* scenes() const { return scenes_.get(); }
  /// Grows with every new picture.
  std::uint64_t revision() const { return revision_; }

 private:
  void start();
  void adopt(std::shared_ptr<const VolumeScenes> scenes);

  Background<std::shared_ptr<const VolumeScenes>> worker_;
  std::optional<VolumeWish> waiting_;
  std::optional<VolumeWish> wanted_;
  std::shared_ptr<const VolumeScenes> scenes_;
  std::uint64_t revision_ = 0;
};

}  // namespace winslow::gui
