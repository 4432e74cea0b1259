#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gui/render/space/space_view.h"
#include "gui/settings/view_options.h"
#include "gui/view/navigation/look_control.h"

namespace winslow::gui {

/// Where the user looks at a mesh of space.
class SpaceControl : public LookControl {
 public:
  explicit SpaceControl(const Session& session) : LookControl(session, 2) {}

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
  /// In every frame: the parts of the options that the camera has.
  void follow(const SpaceOptions& options);

  void fit_all() override;
  /// All where nothing is enclosed.
  void fit_bodies() override;
  void look_at(const Vec3& point, double radius) override;
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
