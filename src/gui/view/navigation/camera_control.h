#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/navigation/view_history.h"

namespace winslow::gui {

/// Moves the camera by which a mesh of one kind is looked at. All of it needs an open mesh.
class CameraControl {
 public:
  CameraControl() = default;
  virtual ~CameraControl() = default;
  CameraControl(const CameraControl&) = delete;
  CameraControl& operator=(const CameraControl&) = delete;

  virtual const View& view() const = 0;
  virtual View& view() = 0;

  /// A mesh has come: looks at all of it, or at its bodies, or as it was looked at before. options
  /// get what the mesh is first looked at with.
  virtual void begin(ViewOptions& options) = 0;
  virtual void fit_all() = 0;
  virtual void fit_bodies() = 0;
  virtual void fit_markers(std::span<const Index> markers) = 0;
  /// Looks at an item and what touches it. card: at the foot of the view, if there is one.
  virtual void go_to(const MeshItem& item, const std::optional<ScreenBox>& card) = 0;
  /// A node is on screen.
  virtual bool sees(Index node) const = 0;

  virtual LookedAt looked_at() const = 0;
  /// Looks there again.
  virtual void look_at(const LookedAt& place) = 0;
  /// In every frame: the parts of the options that the camera has.
  virtual void update(const ViewOptions& options) = 0;
};

/// That of plane meshes.
class PlaneControl : public CameraControl {
 public:
  explicit PlaneControl(const Session& session) : session_(session) {}

  const PlaneView& view() const override { return view_; }
  PlaneView& view() override { return view_; }
  const Camera& camera() const { return view_.camera(); }

  void begin(ViewOptions& options) override;
  void fit_all() override;
  /// Nothing where there are none.
  void fit_bodies() override;
  void fit_markers(std::span<const Index> markers) override;
  void go_to(const MeshItem& item, const std::optional<ScreenBox>& card) override;
  bool sees(Index node) const override;
  LookedAt looked_at() const override { return winslow::gui::looked_at(view_.camera()); }
  void look_at(const LookedAt& place) override { winslow::gui::look_at(view_.camera(), place); }
  void update(const ViewOptions& /*options*/) override {}
  /// radius: shown around the point, in units of the mesh; above the card.
  void look_around(const Vec2& point, double radius, const std::optional<ScreenBox>& card);

 private:
  std::vector<Index> body_nodes() const;

  const Session& session_;
  PlaneView view_;
};

/// Moves what is in the middle of a view up, and away, so that a card at its foot does not cover
/// it. A card that does not reach the middle leaves it alone.
void look_above(Camera& camera, const ScreenBox& card);
void look_above(SpaceCamera& camera, const ScreenBox& card);

}  // namespace winslow::gui
