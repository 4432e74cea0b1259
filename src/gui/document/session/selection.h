#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gui/document/actions/dispatch.h"
#include "gui/document/actions/selection_actions.h"
#include "gui/document/selection/body_anchors.h"
#include "gui/document/selection/node_selection.h"
#include "gui/document/selection/shape_edit.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"

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

  /// Point about which the selection turns, where it is on screen now.
  Vec2 pivot() const;
  /// The same of a volume mesh, and the axis about which it turns.
  Vec3 space_pivot() const;
  Vec3 space_axis() const;
  /// What both were taken from, as seen from the state before the job under way.
  const SpacePivot& pivot_in_space() const { return space_pivot_; }
  /// What the next click picks a pivot from.
  const std::optional<action::PickPivot>& pivot_pick() const { return pivot_pick_; }
  /// Where the pivot was put; none: to a place of its own.
  std::optional<PivotPlace> pivot_place() const { return pivot_place_; }
  /// Points of the selection where it stands between motions; none without a selection.
  const std::optional<BodyAnchors>& anchors() const { return anchors_; }
  /// A command has moved bodies.
  void moved(const MoveCommand& move);

  const ShapeEdit& shape_edit() const { return shape_edit_; }
  /// radius: as action::SetShapeEdit.
  void edit_shape(bool active, double radius);
  /// The patch that is held of a volume mesh, in the mesh of the history.
  struct HeldPatch {
    DragGrip grip;
    Vec3 centre{0, 0, 0};
    Vec3 normal{0, 0, 1};  ///< of the surface around it, of length 1, out of the mesh
  };
  /// Null: nothing is held.
  const HeldPatch* held_patch() const;
  /// A deformation of the selection that is not yet carried out.
  struct DeformationPreview {
    SineDeformation shape;
    std::vector<std::pair<Vec3, Vec3>> outline;  ///< edges where it would put them
  };
  const std::optional<DeformationPreview>& deformation_preview() const { return preview_; }
  /// A rigid motion of the selection that is typed but not yet carried out.
  struct MotionPreview {
    RigidMotionRequest motion;
    std::vector<std::pair<Vec3, Vec3>> outline;  ///< edges where it would put them
  };
  const std::optional<MotionPreview>& motion_preview() const { return motion_preview_; }
  /// Edges that show the form of what is selected, of a volume mesh: all that are sharp, and some
  /// of the others.
  const std::vector<std::array<Index, 2>>& outline_in_space() const;
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
  void follow(const std::shared_ptr<const Topology>& before,
              const std::shared_ptr<const Topology>& now);
  void clear();

 private:
  friend class Dispatch;
  void on(const action::SelectMarkers& a);
  void on(const action::HoverMarkers& a) { hovered_ = a.markers; }
  void on(const action::SetPivot& a);
  void on(const action::SetSpacePivot& a);
  void on(const action::SetSpaceAxis& a);
  void on(const action::TakePivot& a);
  void on(const action::PickPivot& a);
  void on(const action::SelectArc& a) { shape_edit_.arc = a.arc; }
  void on(const action::SelectPatch& a) { shape_edit_.patch = a.patch; }
  void on(const action::PreviewDeformation& a);
  void on(const action::PreviewMotion& a);
  void on(const action::SelectNode& a);
  void on(const action::HoverNode& a);
  void on(const action::PinNodes& a);

  bool exists(Index node) const;
  void place_pivot();
  void place_space_pivot();
  void keep_space_pivot();
  void recall_space_pivot();
  double smallest_body() const;
  void follow_nodes(const std::shared_ptr<const Topology>& before,
                    const std::shared_ptr<const Topology>& now);

  const LiveMesh& mesh_;
  MessageBoard& messages_;
  std::vector<Index> markers_, hovered_;
  Vec2 pivot_{0, 0};  // seen from the state before the job under way
  std::optional<PivotPlace> pivot_place_ = PivotPlace::centre;
  std::optional<BodyAnchors> anchors_;
  SpacePivot space_pivot_;  // likewise
  // Pivots that were typed or picked, by selection: it finds them again.
  std::map<std::vector<Index>, SpacePivot> space_pivots_;
  std::optional<action::PickPivot> pivot_pick_;
  mutable std::optional<std::vector<std::array<Index, 2>>> outline_;  // as it is asked for
  /// Likewise, and what it was made for.
  struct MadePatch {
    SurfacePatch patch;
    double radius;
    std::uint64_t revision;
    HeldPatch held;
  };
  mutable std::optional<MadePatch> held_patch_;
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

/// Largest extent of the smallest marker of a volume mesh.
double smallest_marker(const Mesh& mesh);

}  // namespace winslow::gui
