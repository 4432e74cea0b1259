#pragma once

#include "gui/render/space/space_view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/navigation/camera_control.h"

namespace winslow::gui {

/// That of meshes in space.
class SpaceControl : public CameraControl {
 public:
  explicit SpaceControl(const Session& session) : CameraControl(session, 2) {}

  const SpaceView& view() const override { return view_; }
  SpaceView& view() override { return view_; }
  const SpaceCamera& camera() const { return view_.camera(); }

  /// A volume mesh has come, or goes: what it was looked at by is kept for when it is back. options
  /// get the cuts that it has, or those to begin with.
  void leave(const ViewOptions& options);
  void begin(ViewOptions& options) override;
  /// How meshes were looked at, the last one first: the open one among them.
  std::vector<KeptView> views(const ViewOptions& options) const;
  /// As they were kept from the last run.
  void set_views(std::vector<KeptView> views) { kept_ = std::move(views); }
  void update(const ViewOptions& options) override;

  void fit_all() override;
  /// All where nothing is enclosed.
  void fit_bodies() override;
  void look_around(const Vec3& point, double radius) override;
  void look_from(const ViewDirection& direction);

 private:
  void fit(std::span<const Index> nodes, double margin) override;
  std::vector<Index> body_nodes() const;
  std::vector<CutPlane> first_cuts() const;

  KeptView view_now(const ViewOptions& options) const;

  SpaceView view_;
  std::vector<KeptView> kept_;                 // the last one first
  std::optional<std::filesystem::path> open_;  // that is looked at now
};

}  // namespace winslow::gui
