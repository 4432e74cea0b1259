#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gui/document/session/session.h"
#include "gui/render/space/space_view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

namespace winslow::gui {

/// Where the user looks in space. Knows nothing of OpenGL or of widgets.
class SpaceControl {
 public:
  explicit SpaceControl(const Session& session) : session_(session) {}

  const SpaceView& view() const { return view_; }
  SpaceView& view() { return view_; }
  const SpaceCamera& camera() const { return view_.camera(); }

  /// A volume mesh has come, or goes: what it was looked at by is kept for when it is back. options
  /// get the cuts that it has, or those to begin with.
  void leave(const ViewOptions& options);
  void begin(ViewOptions& options);
  /// How meshes were looked at, the last one first: the open one among them.
  std::vector<KeptView> views(const ViewOptions& options) const;
  /// As they were kept from the last run.
  void set_views(std::vector<KeptView> views) { kept_ = std::move(views); }
  /// In every frame: the parts of the options that the camera has.
  void follow(const SpaceOptions& options);

  void fit_all();
  /// Of bodies, or all where nothing is enclosed.
  void fit_bodies();
  void fit_markers(std::span<const Index> markers);
  void look_at(const Vec3& point, double radius);
  /// Looks at an item and what touches it.
  void go_to(const MeshItem& item);
  /// Shows what lies in a box of the screen as large as there is room for; depth: of a point.
  void zoom_to(const ScreenBox& box, const Vec3& depth);
  void look_from(const ViewDirection& direction);

 private:
  void fit(std::span<const Index> nodes, double margin);
  std::vector<Index> body_nodes() const;
  std::vector<CutPlane> first_cuts() const;

  const Session& session_;
  SpaceView view_;
  KeptView view_now(const ViewOptions& options) const;

  std::vector<KeptView> kept_;                 // the last one first
  std::optional<std::filesystem::path> open_;  // that is looked at now
};

/// Box around an item of a volume mesh and what touches it.
Box<3> space_surroundings(const MeshItem& item, const Mesh& mesh);

}  // namespace winslow::gui
