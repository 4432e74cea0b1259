#pragma once

#include "gui/document/actions/document_actions.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"

namespace winslow::gui {

/// What a selection has of its own in a volume mesh: the axis about which it turns, its outline,
/// what is held of its surface.
class SpaceSelection {
 public:
  SpaceSelection(const LiveMesh& mesh, MessageBoard& messages) : mesh_(mesh), messages_(messages) {}

  /// A point of the axis, and its direction, where they are on screen now.
  Vec3 pivot() const;
  Vec3 axis() const;
  /// Of the bounding box of what is selected, in the mesh of the history; of nothing, the origin.
  Vec3 centre() const;
  /// What both were taken from, as seen from the state before the job under way.
  const SpacePivot& source() const { return pivot_; }
  /// What the next click picks a pivot from.
  const std::optional<action::PickPivot>& pick() const { return pick_; }
  /// Edges that show the form of what is selected: all that are sharp, and some of the others.
  const std::vector<std::array<Index, 2>>& outline() const;
  /// The patch that is held, in the mesh of the history.
  struct HeldPatch {
    DragGrip grip;
    Vec3 centre{0, 0, 0};
    Vec3 normal{0, 0, 1};  ///< of the surface around it, of length 1, out of the mesh
  };
  /// Null: nothing is held.
  const HeldPatch* held(const ShapeEdit& edit) const;

  /// Other markers are selected, whose pivot is found again.
  void choose(const std::vector<Index>& markers);
  /// none: at the centre of what is selected.
  void set_pivot(const std::optional<Vec3>& pivot);
  void set_axis(const Vec3& axis);
  void set_source(const PivotSource& source);
  void wait_for(const action::PickPivot& pick);
  /// A command has moved a body.
  void moved(const MovingBody& body);
  /// The document has come to another mesh.
  void place();
  /// The same after a command: a picked pivot goes where its nodes are.
  void follow_nodes();
  void clear();

 private:
  std::vector<std::string> names() const;

  const LiveMesh& mesh_;
  MessageBoard& messages_;
  std::vector<Index> markers_;  // that are selected
  SpacePivot pivot_;            // seen from the state before the job under way
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

/// Largest extent of the smallest marker of a volume mesh.
double smallest_marker(const Mesh& mesh);

}  // namespace winslow::gui
