#pragma once

#include <span>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

namespace winslow::gui {

/// Where the user looks at a mesh: one for meshes of the plane, one for those of space. Knows
/// nothing of OpenGL or of widgets.
class LookControl {
 public:
  virtual ~LookControl() = default;

  virtual View& view() = 0;
  virtual const View& view() const = 0;
  /// A mesh has come: looks at all of it, or at its bodies where they would be dots.
  virtual void begin(ViewOptions& options) = 0;

  virtual void fit_all() = 0;
  virtual void fit_bodies() = 0;
  void fit_markers(std::span<const Index> markers);
  /// Shows what lies around a point.
  virtual void look_at(const Vec3& point, double radius) = 0;
  /// Looks at an item and what touches it.
  void go_to(const MeshItem& item);
  /// Shows what lies in a box of the screen as large as there is room for. depth: a point as deep
  /// as what is meant.
  void zoom_to(const ScreenBox& box, const Vec3& depth);
  /// Moves what is in the middle of the view up, and away, so that a card at its foot does not
  /// cover it. A card that does not reach the middle leaves it alone.
  void look_above(const ScreenBox& card);

 protected:
  /// room: what is shown around an item that one goes to, in its own sizes.
  LookControl(const Session& session, double room) : session_(session), room_(room) {}
  /// Shows nodes of the mesh on screen. margin: a share of the viewport on each side.
  virtual void fit(std::span<const Index> nodes, double margin) = 0;

  const Session& session_;

 private:
  double room_;
};

/// Box around an item of the open mesh and what touches it; in the plane z = 0.
Box<3> surroundings(const MeshItem& item, const Session& session);

/// Where the user looks at a mesh of the plane.
class PlaneControl : public LookControl {
 public:
  explicit PlaneControl(const Session& session) : LookControl(session, 4) {}

  PlaneView& view() override { return view_; }
  const PlaneView& view() const override { return view_; }
  void begin(ViewOptions& options) override;
  void fit_all() override;
  void fit_bodies() override;
  void look_at(const Vec3& point, double radius) override;

 private:
  void fit(std::span<const Index> nodes, double margin) override;
  std::vector<Index> body_nodes() const;

  PlaneView view_;
};

}  // namespace winslow::gui
