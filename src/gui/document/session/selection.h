#pragma once

#include "gui/document/actions/document_actions.h"
#include "gui/document/selection/boundary_index.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/document/selection/pivot.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"

namespace winslow::gui {

/// What the selected markers of a mesh of one kind turn about, and what shows their form: one for
/// meshes of the plane, one for those in space. The markers are the selection's.
class BodySelection {
 public:
  virtual ~BodySelection() = default;
  BodySelection(const BodySelection&) = delete;
  BodySelection& operator=(const BodySelection&) = delete;

  /// Where it is on screen now; z = 0 in the plane.
  Vec3 pivot() const;
  /// Of the bounding box of what is selected, in the mesh of the history; none: it has no nodes.
  virtual std::optional<Vec3> centre() const = 0;
  /// Edges that show the form of what is selected, by their nodes.
  virtual std::vector<std::array<Index, 2>> outline() const = 0;
  /// Largest extent of the smallest body of the mesh.
  virtual double smallest_body() const = 0;

  // A plane mesh has nothing of this.
  /// none: at the centre of what is selected.
  virtual void set_space_pivot(const std::optional<Vec3>& /*pivot*/) {}
  virtual void set_axis(const Vec3& /*axis*/) {}
  virtual void set_source(const PivotSource& /*source*/) {}
  virtual void wait_for(const action::PickPivot& /*pick*/) {}

  /// Other markers are about to be selected.
  virtual void leave() {}
  /// They are: their pivot is found.
  virtual void begin() = 0;
  /// A command has moved a body, resolved as the mesh makes it. alone: it has moved no other.
  virtual void moved(const std::vector<std::string>& body, const RigidMotion& motion,
                     bool alone) = 0;
  /// The document has come to another mesh.
  virtual void place() = 0;
  /// The same after a command: what was found by nodes goes where they are.
  virtual void follow_nodes() = 0;
  virtual void clear() = 0;

 protected:
  BodySelection(const LiveMesh& mesh, const std::vector<Index>& markers)
      : mesh_(mesh), markers_(markers) {}
  /// All of these markers are of the body.
  bool goes(const std::vector<Index>& markers, const std::vector<std::string>& body) const;

  const LiveMesh& mesh_;
  const std::vector<Index>& markers_;  // that are selected
  SpacePivot pivot_;                   // seen from the state before the job under way
};

/// That of a plane mesh: a pivot that stays where it is, or at a place of the bodies with a name.
class PlaneSelection : public BodySelection {
 public:
  PlaneSelection(const LiveMesh& mesh, const std::vector<Index>& markers)
      : BodySelection(mesh, markers) {}

  /// Where the pivot was put; none: to a place of its own.
  const std::optional<PivotPlace>& pivot_place() const { return place_; }
  /// Points of the selection where it stands between motions; none without a selection.
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

/// That of a mesh in space: with the axis about which it turns, and what is held of its surface.
class SpaceSelection : public BodySelection {
 public:
  SpaceSelection(const LiveMesh& mesh, const std::vector<Index>& markers, MessageBoard& messages)
      : BodySelection(mesh, markers), messages_(messages) {}

  /// Of the axis through the pivot, where it is on screen now.
  Vec3 axis() const;
  /// What both were taken from, as seen from the state before the job under way.
  const SpacePivot& source() const { return pivot_; }
  /// What the next click picks a pivot from.
  const std::optional<action::PickPivot>& pick() const { return pick_; }
  /// The patch that is held, in the mesh of the history.
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
  /// All edges that are sharp, and some of the others.
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
  // Those that were typed or picked, by selection.
  std::map<std::vector<Index>, SpacePivot> kept_;
  std::optional<action::PickPivot> pick_;
  mutable std::optional<std::vector<std::array<Index, 2>>> outline_;  // as it is asked for
  /// Likewise, and what it was made for.
  struct MadePatch {
    SurfacePatch patch;
    double radius;
    std::uint64_t revision;
    HeldPatch held;
  };
  mutable std::optional<MadePatch> held_;
};

/// What the user has taken: markers with the point about which they turn, an arc of the boundary,
/// nodes. Follows the mesh on screen.
class Selection {
 public:
  Selection(const LiveMesh& mesh, MessageBoard& messages) : mesh_(mesh), messages_(messages) {}

  /// Ascending.
  const std::vector<Index>& markers() const { return markers_; }
  bool empty() const { return markers_.empty(); }
  bool contains(Index marker) const;
  std::vector<std::string> names() const { return marker_names(*mesh_.topology(), markers_); }
  const std::vector<Index>& hovered() const { return hovered_; }

  /// Point about which the selection turns, where it is on screen now; of a plane mesh.
  Vec2 pivot() const { return plane_.pivot().head<2>(); }
  /// The same of any mesh; z = 0 in the plane.
  Vec3 space_pivot() const { return own().pivot(); }
  /// What it has of its own in a mesh of the kind that is open, in a plane mesh, in one in space.
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
  /// A command has moved bodies.
  void moved(const MoveCommand& move);

  const ShapeEdit& shape_edit() const { return shape_edit_; }
  /// radius: as action::SetShapeEdit.
  void edit_shape(bool active, double radius);
  /// A deformation of the selection that is not yet carried out.
  struct DeformationPreview {
    SineDeformation shape;
    std::vector<std::pair<Vec3, Vec3>> outline;  ///< edges where it would put them
  };
  const std::optional<DeformationPreview>& deformation_preview() const { return preview_; }
  /// A rigid motion of the selection that is typed but not yet carried out.
  struct MotionPreview {
    RigidMotion motion;
    std::vector<std::pair<Vec3, Vec3>> outline;  ///< edges where it would put them
  };
  const std::optional<MotionPreview>& motion_preview() const { return motion_preview_; }
  void drop_preview() {
    preview_.reset();
    motion_preview_.reset();
  }

  const NodeSelection& nodes() const { return nodes_; }

  /// The document has come to another mesh of its history.
  void refresh();
  /// The mesh on screen is of another connectivity. Nodes keep their numbers when layers are
  /// inserted and removed; what refers to anything else is let go of.
  void carry_over(const std::shared_ptr<const Topology>& before,
                  const std::shared_ptr<const Topology>& now);
  void clear();

  void on(const action::SelectMarkers& a);
  void on(const action::HoverMarkers& a) { hovered_ = a.markers; }
  void on(const action::SetPivot& a) { plane_.set_pivot(a); }
  // Plane meshes have no use for these.
  void on(const action::SetSpacePivot& a) { own().set_space_pivot(a.pivot); }
  void on(const action::SetSpaceAxis& a) { own().set_axis(a.axis); }
  void on(const action::TakePivot& a) { own().set_source(a.source); }
  void on(const action::PickPivot& a) { own().wait_for(a); }
  void on(const action::SelectArc& a) { shape_edit_.arc = a.arc; }
  void on(const action::SelectPatch& a) { shape_edit_.patch = a.patch; }
  void on(const action::PreviewDeformation& a);
  void on(const action::PreviewMotion& a);
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
  NodeSelection nodes_;
  /// Nodes that were let go of when the mesh on screen came to be of another connectivity.
  struct LostNodes {
    std::weak_ptr<const Topology> topology;  ///< of which they are
    std::vector<Index> pinned;
    std::optional<Index> inspected;
  };
  std::vector<LostNodes> lost_nodes_;
};

}  // namespace winslow::gui
