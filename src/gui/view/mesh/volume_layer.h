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

/// What is wanted of a picture of a mesh in space: all that its scene depends on.
struct VolumeWish {
  std::uint64_t generation = 0, shape = 0;
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const VolumeBoundary> boundary;
  /// Values to colour by; null: plain elements, or none measured yet.
  std::shared_ptr<const QualityMonitor::Measured> measured;
  ColorChoice colors;
  Isolation isolation;
  std::vector<CutPlane> cuts;  ///< that are on
  Peel peel;                   ///< that is on, of a marker that there is
  bool crinkle = false;
  bool mark_inverted = true;
  std::vector<Index> worst;  ///< elements that are to be seen through what hides them
  bool surfaces = true, edges = true;
  std::vector<MarkerShow> markers;
  std::vector<float> opacity;
  std::vector<Rgb> marker_colors;
  std::vector<Rgb> border_colors;               ///< of the markers of a surface mesh
  double feature_angle = 40;                    ///< degrees; see VolumeLook
  std::shared_ptr<const SurfaceShape> surface;  ///< of a surface mesh: which side is right
  VolumeStyle style;
  bool ghost = false;  ///< the bodies alone, as lines

  bool operator==(const VolumeWish&) const = default;
};

/// A picture of a volume mesh, ready to be drawn. Its parts are those of the picture before where
/// nothing has changed for them.
struct VolumeScenes {
  VolumeWish of;
  ShownMesh shown;
  std::vector<std::shared_ptr<const SpaceScene>> parts;
  std::vector<Plane> planes;
  std::optional<Legend> legend;
  struct Memory;
  std::shared_ptr<const Memory> memory;  ///< of what was made, for the next picture
};

/// Makes the scenes of a volume mesh, of a large one in the background: until they are made, the
/// picture is the last one.
class VolumeLayer {
 public:
  void want(VolumeWish wish);
  /// Takes what the background has made. True if the picture changes.
  bool poll();
  /// The picture is not what was last wanted yet.
  bool busy() const { return worker_.busy() || waiting_.has_value(); }
  void clear();

  /// Null before the first picture of a mesh.
  const VolumeScenes* scenes() const { return scenes_.get(); }
  /// Grows with every other picture.
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
