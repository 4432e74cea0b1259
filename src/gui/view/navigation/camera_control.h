#pragma once

#include "gui/document/session/session.h"
#include "gui/render/space/space_view.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

namespace winslow::gui {

/// Moves the camera by which a mesh of one kind is looked at: one for meshes of the plane, one for
/// those of space. All of it needs an open mesh. Knows nothing of OpenGL or of widgets.
///
///     control.fit_markers(selection.markers());
///     control.go_to(item);
class CameraControl {
 public:
  virtual ~CameraControl() = default;
  CameraControl(const CameraControl&) = delete;
  CameraControl& operator=(const CameraControl&) = delete;

  virtual const View& view() const = 0;
  virtual View& view() = 0;

  /// A mesh has come: looks at all of it, or at its bodies where they would be dots, or as it was
  /// looked at before. options get what the mesh is first looked at with.
  virtual void begin(ViewOptions& options) = 0;
  /// In every frame: the parts of the options that the camera has.
  virtual void update(const ViewOptions& options) = 0;

  virtual void fit_all() = 0;
  virtual void fit_bodies() = 0;
  /// Nothing where the markers have no nodes.
  void fit_markers(std::span<const Index> markers);
  /// Shows what lies around a point. radius: in units of the mesh.
  virtual void look_around(const Vec3& point, double radius) = 0;
  /// Looks at an item and what touches it.
  void go_to(const MeshItem& item);
  /// A node is on screen.
  bool sees(Index node) const;
  /// Shows what lies in a box of the screen as large as there is room for. depth: a point as deep
  /// as what is meant.
  void zoom_to(const ScreenBox& box, const Vec3& depth);
  /// Moves what is in the middle of the view up, and away, so that a card at its foot does not
  /// cover it. A card that does not reach the middle leaves it alone.
  void look_above(const ScreenBox& card);

 protected:
  /// room: what is shown around an item that one goes to, in its own sizes.
  CameraControl(const Session& session, double room) : session_(session), room_(room) {}
  /// Shows nodes of the mesh on screen. margin: a share of the viewport on each side.
  virtual void fit(std::span<const Index> nodes, double margin) = 0;

  const Session& session_;

 private:
  double room_;
};

/// That of plane meshes.
class PlaneControl : public CameraControl {
 public:
  explicit PlaneControl(const Session& session) : CameraControl(session, 4) {}

  const Camera& view() const override { return view_; }
  Camera& view() override { return view_; }

  void begin(ViewOptions& options) override;
  void update(const ViewOptions& /*options*/) override {}
  void fit_all() override;
  /// Nothing where there are none.
  void fit_bodies() override;
  void look_around(const Vec3& point, double radius) override;

 private:
  void fit(std::span<const Index> nodes, double margin) override;
  std::vector<Index> body_nodes() const;

  Camera view_;
};

/// That of meshes in space.
class SpaceControl : public CameraControl {
 public:
  explicit SpaceControl(const Session& session) : CameraControl(session, 2) {}

  const SpaceCamera& view() const override { return view_; }
  SpaceCamera& view() override { return view_; }

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

  SpaceCamera view_;
  std::vector<KeptView> kept_;                 // the last one first
  std::optional<std::filesystem::path> open_;  // that is looked at now
};

}  // namespace winslow::gui
