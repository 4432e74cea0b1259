#pragma once

#include "gui/document/actions/document_actions.h"
#include "gui/document/selection/boundary_index.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/document/selection/pivot.h"
#include "gui/document/session/body_plan.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"

namespace winslow::gui {

/// Edges that show the shape of markers (ascending), as pairs of nodes. In space all sharp edges
/// and some of the others, since all of them would be too dense.
std::vector<std::array<Index, 2>> outline_of(const LiveMesh& mesh,
                                             const std::vector<Index>& markers);

/// Pivot and outline of the selected markers: one class for plane meshes, one for meshes in space.
/// The markers belong to the Selection.
class BodySelection {
 public:
  virtual ~BodySelection() = default;
  BodySelection(const BodySelection&) = delete;
  BodySelection& operator=(const BodySelection&) = delete;

  /// The pivot in the mesh on screen; z = 0 in the plane.
  Vec3 pivot() const;
  /// Centre of the selection's bounding box in the mesh of the history; none: it has no nodes.
  virtual std::optional<Vec3> centre() const = 0;
  /// outline_of() the selection.
  virtual std::vector<std::array<Index, 2>> outline() const = 0;
  /// Largest extent of the smallest body of the mesh.
  virtual double smallest_body() const = 0;

  // These have no effect for a plane mesh.
  /// none: at the centre of the selection.
  virtual void set_space_pivot(const std::optional<Vec3>& /*pivot*/) {}
  virtual void set_axis(const Vec3& /*axis*/) {}
  virtual void set_source(const PivotSource& /*source*/) {}
  virtual void wait_for(const action::PickPivot& /*pick*/) {}

  /// Called before other markers are selected.
  virtual void leave() {}
  /// Called after that: finds their pivot.
  virtual void begin() = 0;
  /// Called after a command has moved a body. motion: resolved for the mesh. alone: only this body
  /// was moved.
  virtual void moved(const std::vector<std::string>& body, const RigidMotion& motion,
                     bool alone) = 0;
  /// Called when the document has moved to another mesh.
  virtual void place() = 0;
  /// The same after a command: quantities defined by nodes move with the nodes.
  virtual void follow_nodes() = 0;
  virtual void clear() = 0;

 protected:
  BodySelection(const LiveMesh& mesh, const std::vector<Index>& markers)
      : mesh_(mesh), markers_(markers) {}
  /// True if all these markers belong to the body.
  bool goes(const std::vector<Index>& markers, const std::vector<std::string>& body) const;

  const LiveMesh& mesh_;
  const std::vector<Index>& markers_;  // the selected ones
  SpacePivot pivot_;                   // in the state before the running job
};

/// For plane meshes: the pivot is a fixed point or a named point of the bodies.
class PlaneSelection : public BodySelection {
 public:
  PlaneSelection(const LiveMesh& mesh, const std::vector<Index>& markers)
      : BodySelection(mesh, markers) {}

  /// The named point of the pivot; none: a fixed point.
  const std::optional<PivotPlace>& pivot_place() const { return place_; }
  /// Named points of the selection between motions; none without a selection.
  const std::optional<BodyAnchors>& anchors() const { return anchors_; }
  void set_pivot(const action::SetPivot& a);

  std::optional<Vec3> centre() const override;
  std::vector<std::array<Index, 2>> outline() const override;
  double smallest_body() const override;
  void begin() override;
  void moved(const std::vector<std::string>& body, const RigidMotion& motion, bool alone) override;
  void place() override;
  void follow_nodes() override;
  void clear() override;

 private:
  std::optional<PivotPlace> place_ = PivotPlace::centre;
  std::optional<BodyAnchors> anchors_;
};

/// For meshes in space: adds the axis of rotation and the held patch of the surface.
class SpaceSelection : public BodySelection {
 public:
  SpaceSelection(const LiveMesh& mesh, const std::vector<Index>& markers, MessageBoard& messages)
      : BodySelection(mesh, markers), messages_(messages) {}

  /// Direction of the axis through the pivot, in the mesh on screen.
  Vec3 axis() const;
  /// The source of pivot and axis, in the state before the running job.
  const SpacePivot& source() const { return pivot_; }
  /// The kind of source that the next click picks as a pivot.
  const std::optional<action::PickPivot>& pick() const { return pick_; }
  /// The held patch in the mesh of the history.
  struct HeldPatch {
    DragGrip grip;
    Vec3 centre{0, 0, 0};
    Vec3 normal{0, 0, 1};  ///< of the surface around it, of length 1, out of the mesh
  };
  /// Null: nothing is held.
  const HeldPatch* held(const ShapeEdit& edit) const;

  void set_space_pivot(const std::optional<Vec3>& pivot) override;
  void set_axis(const Vec3& axis) override;
  void set_source(const PivotSource& source) override;
  void wait_for(const action::PickPivot& pick) override;
  std::optional<Vec3> centre() const override;
  std::vector<std::array<Index, 2>> outline() const override;
  double smallest_body() const override;
  void leave() override;
  void begin() override;
  void moved(const std::vector<std::string>& body, const RigidMotion& motion, bool alone) override;
  void place() override;
  void follow_nodes() override;
  void clear() override;

 private:
  MessageBoard& messages_;
  // Typed or picked pivots, by selection.
  std::map<std::vector<Index>, SpacePivot> kept_;
  std::optional<action::PickPivot> pick_;
  mutable std::optional<std::vector<std::array<Index, 2>>> outline_;  // made on request
  /// Cached patch with its inputs.
  struct MadePatch {
    SurfacePatch patch;
    double radius;
    std::uint64_t revision;
    HeldPatch held;
  };
  mutable std::optional<MadePatch> held_;
};

/// The user's selection: markers with their pivot, an arc of the boundary, nodes. Is kept up to
/// date with the mesh on screen.
class Selection {
 public:
  Selection(const LiveMesh& mesh, MessageBoard& messages) : mesh_(mesh), messages_(messages) {}

  /// Ascending.
  const std::vector<Index>& markers() const { return markers_; }
  bool empty() const { return markers_.empty(); }
  bool contains(Index marker) const;
  std::vector<std::string> names() const { return marker_names(*mesh_.topology(), markers_); }
  const std::vector<Index>& hovered() const { return hovered_; }

  /// Pivot of the selection in the plane mesh on screen.
  Vec2 pivot() const { return plane_.pivot().head<2>(); }
  /// Pivot in any mesh on screen; z = 0 in the plane.
  Vec3 space_pivot() const { return own().pivot(); }
  /// The part for the dimension of the open mesh, plane or in space.
  const BodySelection& own() const {
    if (in_space(mesh_)) return space_;
    return plane_;
  }
  BodySelection& own() {
    if (in_space(mesh_)) return space_;
    return plane_;
  }
  const SpaceSelection& space() const { return space_; }
  std::optional<PivotPlace> pivot_place() const { return plane_.pivot_place(); }
  const std::optional<BodyAnchors>& anchors() const { return plane_.anchors(); }
  /// Called when the command of plan() has begun.
  void begin_plan() { plan_.begin(); }
  /// Called after a command has moved bodies.
  void moved(const MoveCommand& move);

  const ShapeEdit& shape_edit() const { return shape_edit_; }
  /// radius: see action::SetShapeEdit.
  void edit_shape(bool active, double radius);
  /// A deformation of the selection that has not been carried out.
  struct DeformationPreview {
    SineDeformation shape;
    std::vector<std::pair<Vec3, Vec3>> outline;  ///< edges in their new position
  };
  const std::optional<DeformationPreview>& deformation_preview() const { return preview_; }
  /// A typed rigid motion of the selection that has not been carried out.
  struct MotionPreview {
    RigidMotion motion;
    std::vector<std::pair<Vec3, Vec3>> outline;  ///< edges in their new position
  };
  const std::optional<MotionPreview>& motion_preview() const { return motion_preview_; }
  void drop_preview() {
    preview_.reset();
    motion_preview_.reset();
  }

  const NodeSelection& nodes() const { return nodes_; }
  /// Bodies listed to move together.
  const BodyPlan& plan() const { return plan_; }

  /// Called when the document has moved to another position of its history.
  void refresh();
  /// Called when the connectivity of the mesh on screen has changed. Nodes keep their numbers when
  /// layers are inserted or removed; references to other items are dropped.
  void carry_over(const std::shared_ptr<const Topology>& before,
                  const std::shared_ptr<const Topology>& now);
  void clear();

  void on(const action::SelectMarkers& a);
  void on(const action::HoverMarkers& a) { hovered_ = a.markers; }
  void on(const action::SetPivot& a) { plane_.set_pivot(a); }
  // These have no effect for plane meshes.
  void on(const action::SetSpacePivot& a) { own().set_space_pivot(a.pivot); }
  void on(const action::SetSpaceAxis& a) { own().set_axis(a.axis); }
  void on(const action::TakePivot& a) { own().set_source(a.source); }
  void on(const action::PickPivot& a) { own().wait_for(a); }
  void on(const action::SelectArc& a) { shape_edit_.arc = a.arc; }
  void on(const action::SelectPatch& a) { shape_edit_.patch = a.patch; }
  void on(const action::PreviewDeformation& a);
  void on(const action::PreviewMotion& a);
  void on(const action::PlanBody& a);
  void on(const action::UnplanBody& a) { plan_.remove(a.number); }
  void on(const action::ClearBodyPlan&) { plan_.clear(); }
  void on(const action::SelectNode& a);
  void on(const action::HoverNode& a);
  void on(const action::PinNodes& a);

 private:
  bool exists(Index node) const;
  void carry_over_nodes(const std::shared_ptr<const Topology>& before,
                        const std::shared_ptr<const Topology>& now);

  const LiveMesh& mesh_;
  MessageBoard& messages_;
  std::vector<Index> markers_, hovered_;
  PlaneSelection plane_{mesh_, markers_};
  SpaceSelection space_{mesh_, markers_, messages_};
  ShapeEdit shape_edit_;
  std::optional<DeformationPreview> preview_;
  std::optional<MotionPreview> motion_preview_;
  BodyPlan plan_{mesh_};
  NodeSelection nodes_;
  /// Nodes dropped when the connectivity of the mesh on screen changed.
  struct LostNodes {
    std::weak_ptr<const Topology> topology;  ///< in which they exist
    std::vector<Index> pinned;
    std::optional<Index> inspected;
  };
  std::vector<LostNodes> lost_nodes_;
};

}  // namespace winslow::gui
