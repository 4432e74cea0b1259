#pragma once

#include "gui/document/session/session.h"
#include "gui/render/space/space_view.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

namespace winslow::gui {

/// Moves the camera that looks at the open mesh: one subclass for plane meshes, one for meshes in
/// space. All members need an open mesh. Independent of OpenGL and of widgets.
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

  /// Sets the first view of a mesh just opened: the view kept from before, else all of the mesh, or
  /// its bodies where they would be dots. Writes the mesh's first settings to `options`.
  virtual void begin(ViewOptions& options) = 0;
  /// Call in every frame: adopts the options that concern the camera.
  virtual void update(const ViewOptions& options) = 0;

  virtual void fit_all() = 0;
  virtual void fit_bodies() = 0;
  /// Does nothing if the markers have no nodes.
  void fit_markers(std::span<const Index> markers);
  /// Shows what lies around a point. radius: in units of the mesh.
  virtual void look_around(const Vec3& point, double radius) = 0;
  /// Looks at an item and what touches it.
  void go_to(const MeshItem& item);
  /// True if a node is on screen.
  bool sees(Index node) const;
  /// Zooms a box of the screen to fill the viewport. depth: a point at the depth of the box's
  /// content.
  void zoom_to(const ScreenBox& box, const Vec3& depth);
  /// Shrinks the content in the middle of the view and moves it up, so that a card at the view's
  /// foot does not cover it. Does nothing if the card does not reach the middle.
  void look_above(const ScreenBox& card);

 protected:
  /// room: extent shown around an item by go_to(), in multiples of the item's size.
  CameraControl(const Session& session, double room) : session_(session), room_(room) {}
  /// Shows nodes of the mesh on screen. margin: a share of the viewport on each side.
  virtual void fit(std::span<const Index> nodes, double margin) = 0;

  const Session& session_;

 private:
  double room_;
};

/// Camera control of plane meshes.
class PlaneControl : public CameraControl {
 public:
  explicit PlaneControl(const Session& session) : CameraControl(session, 4) {}

  const Camera& view() const override { return view_; }
  Camera& view() override { return view_; }

  void begin(ViewOptions& options) override;
  void update(const ViewOptions& /*options*/) override {}
  void fit_all() override;
  /// Does nothing if there are no bodies.
  void fit_bodies() override;
  void look_around(const Vec3& point, double radius) override;

 private:
  void fit(std::span<const Index> nodes, double margin) override;
  std::vector<Index> body_nodes() const;

  Camera view_;
};

/// Camera control of meshes in space.
class SpaceControl : public CameraControl {
 public:
  explicit SpaceControl(const Session& session) : CameraControl(session, 2) {}

  const SpaceCamera& view() const override { return view_; }
  SpaceCamera& view() override { return view_; }

  /// leave() keeps the view of a mesh for when it is opened again. begin() restores a kept view,
  /// and writes the kept cuts, or else the initial ones, to `options`.
  void leave(const ViewOptions& options);
  void begin(ViewOptions& options) override;
  /// Kept views of meshes, the latest first, that of the open mesh included.
  std::vector<KeptView> views(const ViewOptions& options) const;
  /// Restores the views kept from the last run.
  void set_views(std::vector<KeptView> views) { kept_ = std::move(views); }
  void update(const ViewOptions& options) override;

  void fit_all() override;
  /// Shows the whole mesh if nothing is enclosed.
  void fit_bodies() override;
  void look_around(const Vec3& point, double radius) override;
  void look_from(const ViewDirection& direction);

 private:
  void fit(std::span<const Index> nodes, double margin) override;
  std::vector<Index> body_nodes() const;
  std::vector<CutPlane> first_cuts() const;

  KeptView view_now(const ViewOptions& options) const;

  SpaceCamera view_;
  std::vector<KeptView> kept_;                 // the latest first
  std::optional<std::filesystem::path> open_;  // file of the mesh being looked at
};

}  // namespace winslow::gui
