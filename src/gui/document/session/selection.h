#pragma once

#include "gui/document/actions/dispatch.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/selection/boundary_index.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/document/selection/pivot.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/space_selection.h"

namespace winslow::gui {

/// What the user has taken: markers with the point about which they turn, an arc of the boundary,
/// nodes. Follows the mesh on screen.
class Selection {
 public:
  Selection(const LiveMesh& mesh, MessageBoard& messages) : mesh_(mesh), messages_(messages) {}

  void apply(const SelectionAction& action) { Dispatch::to(*this, action); }

  /// Ascending.
  const std::vector<Index>& markers() const { return markers_; }
  bool empty() const { return markers_.empty(); }
  bool contains(Index marker) const;
  std::vector<std::string> names() const;
  const std::vector<Index>& hovered() const { return hovered_; }

  /// Point about which the selection turns, where it is on screen now; of a plane mesh.
  Vec2 pivot() const;
  /// The same of any mesh; z = 0 in the plane.
  Vec3 space_pivot() const;
  /// Edges that show the form of what is selected, by their nodes.
  std::vector<std::array<Index, 2>> outline() const;
  /// What it has of its own in a volume mesh.
  const SpaceSelection& space() const { return space_; }
  /// Where the pivot was put; none: to a place of its own.
  std::optional<PivotPlace> pivot_place() const { return pivot_place_; }
  /// Points of the selection where it stands between motions; none without a selection.
  const std::optional<BodyAnchors>& anchors() const { return anchors_; }
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
  /// The points of the selection are elsewhere; its pivot stays where it is.
  void update_anchors();
  /// The mesh on screen is of another connectivity. Nodes keep their numbers when layers are
  /// inserted and removed; what refers to anything else is let go of.
  void carry_over(const std::shared_ptr<const Topology>& before,
                  const std::shared_ptr<const Topology>& now);
  void clear();

  void on(const action::SelectMarkers& a);
  void on(const action::HoverMarkers& a) { hovered_ = a.markers; }
  void on(const action::SetPivot& a);
  void on(const action::SetSpacePivot& a) { space_.set_pivot(a.pivot); }
  void on(const action::SetSpaceAxis& a) { space_.set_axis(a.axis); }
  void on(const action::TakePivot& a) { space_.set_source(a.source); }
  void on(const action::PickPivot& a) { space_.wait_for(a); }
  void on(const action::SelectArc& a) { shape_edit_.arc = a.arc; }
  void on(const action::SelectPatch& a) { shape_edit_.patch = a.patch; }
  void on(const action::PreviewDeformation& a);
  void on(const action::PreviewMotion& a);
  void on(const action::SelectNode& a);
  void on(const action::HoverNode& a);
  void on(const action::PinNodes& a);

 private:
  bool exists(Index node) const;
  void place_pivot();
  double smallest_body() const;
  void carry_over_nodes(const std::shared_ptr<const Topology>& before,
                        const std::shared_ptr<const Topology>& now);

  const LiveMesh& mesh_;
  MessageBoard& messages_;
  std::vector<Index> markers_, hovered_;
  Vec2 pivot_{0, 0};  // seen from the state before the job under way
  std::optional<PivotPlace> pivot_place_ = PivotPlace::centre;
  std::optional<BodyAnchors> anchors_;
  SpaceSelection space_{mesh_, messages_};
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

/// The document has come to another mesh of its history: all that refers to the one on screen
/// follows.
void show_position(LiveMesh& mesh, Selection& selection, MessageBoard& messages);

}  // namespace winslow::gui
