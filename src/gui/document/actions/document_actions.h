#pragma once

#include "core/command/command.h"
#include "core/motion/motion.h"
#include "core/motion/rigid_motion.h"
#include "core/types.h"
#include "gui/document/selection/boundary_index.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/document/selection/pivot.h"
#include "gui/settings/option_edits.h"
#include "io/format/mesh_file.h"

namespace winslow::gui::action {

/// Opening, saving and exporting. Carried out by Files.

struct OpenMesh {
  std::filesystem::path path;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
  /// Which of its zones, times and region arrays to read, and whether to mend the mesh.
  io::ReadOptions reading = {};
};
struct SaveMesh {
  std::filesystem::path path;   ///< empty: the file of the mesh
  bool overwrite = false;       ///< false: ask if the file exists
  bool allow_inverted = false;  ///< false: ask if the mesh has inverted elements
  /// Once the mesh is saved, continue with the action given to Files::ask_to_save().
  bool proceed = false;
};
/// Closes the open mesh.
struct CloseMesh {
  bool discard_changes = false;  ///< false: ask if it has unsaved changes
};
/// Writes a copy; the path and the saved state of the open mesh do not change.
struct ExportMesh {
  std::filesystem::path path;
  bool overwrite = false;
};
/// Writes markers as curves (io/tables/table_files.h).
struct ExportMarkers {
  std::filesystem::path path;
  std::vector<Index> markers;  ///< empty: the selected ones or, without a selection, all
  bool overwrite = false;
};
struct ExportRecipe {
  std::filesystem::path path;
  bool overwrite = false;
};
/// Writes the iterations that the convergence plot shows as CSV.
struct ExportConvergence {
  std::filesystem::path path;
  bool overwrite = false;
};
struct Quit {
  bool discard_changes = false;
};

/// Past commands: going back to them and changing them. Carried out by HistoryEditor.

struct Undo {};
struct Redo {};
struct GoToStep {
  std::size_t position = 0;
};
/// Replaces a past command by another one and reruns the commands after it.
struct EditStep {
  std::size_t position = 0;
  Command command;
};
/// Removes a past command and reruns the commands after it.
struct DeleteStep {
  std::size_t position = 0;
};
/// Restores a history that an edit replaced, and keeps the present one in its place.
struct BringBack {
  std::size_t kept = 0;  ///< index into EditHistory::kept()
};
/// Applies the commands of a recipe to the open mesh, one after the other.
struct ReplayRecipe {
  std::filesystem::path path;
};

/// The solver: its commands, its options, and the layers to insert. Carried out by Jobs,
/// SolverSettings and MeshLayers.

struct RunSmooth {};
struct Scramble {
  std::uint64_t seed = 1;
};
struct PauseSolver {};
struct ResumeSolver {};
struct StepSolver {
  int count = 1;
};
struct CancelSolver {};
struct EditSmoothOptions {
  OptionEdit<SmoothOptions> edit;
};
struct EditMotionOptions {
  OptionEdit<MotionOptions> edit;
};
/// Makes two markers periodic in all further runs: their nodes move together. Without `second`,
/// `first` becomes a marker without a periodic partner.
struct PairMarkers {
  std::string first;
  std::optional<std::string> second;
};
/// Holds a boundary node, or lets it slide, in all further runs, against its detected role. Undo
/// reverts this.
struct OverrideNode {
  Index node = 0;
  NodeOverride to = NodeOverride::none;
};
/// Undoes or redoes the last node override of this mesh.
struct StepOverride {
  bool again = false;
};
/// Sets the file of a reference surface on which nodes slide in all further runs, instead of the
/// mesh's own surface. The file is read first; a file that cannot be read changes nothing.
struct ChooseReference {
  std::filesystem::path file;  ///< empty: the mesh's own surface
};
/// Sets the rate at which the outer iterations of the direct method are shown.
struct SetPace {
  double iterations_per_second = 0;  ///< 0: no limit
};
/// Makes the solver wait after every iteration for the next such action, so that all are recorded.
struct FollowSolver {
  bool on = true;
};
/// Carries out any command, in the form used in recipes.
struct RunCommand {
  Command command;
  bool paused = false;  ///< wait before the first iteration
  /// A step of a demo: on a mesh without changes, its result does not count as an unsaved change.
  bool shown_only = false;
};
/// Reruns a command of the history from its original mesh, for the user to watch; starts paused.
/// The history does not change.
struct RerunStep {
  std::size_t position = 1;  ///< see History::command()
};
/// Plans layers and shows them without inserting them; none: ends the preview.
struct PreviewLayers {
  std::optional<LayerOptions> options;
};

/// Answers to messages of the studio. Carried out by MessageBoard.

struct DismissPrompt {};
struct DismissBanner {};
/// Shows a short-lived message about the user's last attempt.
struct Remark {
  std::string text;
};

/// Motions and deformations, typed or dragged. Carried out by Motions.

/// Moves the selected bodies; in the plane or in space, according to the open mesh.
struct ApplyMotion {
  RigidMotion motion;
};
struct ApplyDeformation {
  SineDeformation shape;
};
/// Moves all bodies of the list together, as one command.
struct ApplyBodyPlan {};
/// Moves the nodes that a file names, on the boundary and inside, and smooths the mesh around them;
/// the rest of the boundary stays. The file is read first; a file that cannot be read changes
/// nothing.
struct MoveNodesOfFile {
  std::filesystem::path file;
  bool positions = false;  ///< the file says where nodes are afterwards, not how far they move
};
/// Switches shape editing, and sets the distance along the boundary over which a drag fades, in
/// units of the mesh.
struct SetShapeEdit {
  bool active = false;
  double radius = 0;
};
/// Begins a drag: the mesh follows every DragTo until EndDrag. Motions are relative to BeginDrag.
struct BeginDrag {
  bool shape = false;  ///< drags the arc or patch of the shape edit, not the selected bodies
};
struct DragTo {
  RigidMotion motion;  ///< of the dimension of the open mesh; contains its pivot
};
struct EndDrag {};
struct CancelDrag {};

/// The selected, hovered, pinned and inspected items. Carried out by Selection.

struct SelectMarkers {
  std::vector<Index> markers;
  bool toggle = false;  ///< true: add or remove; false: select only these
};
struct HoverMarkers {
  std::vector<Index> markers;
};
struct SetPivot {
  std::optional<Vec2> pivot;  ///< none: at `place`
  PivotPlace place = PivotPlace::centre;
};
/// Sets the pivot in a volume mesh; none: at the centre of the selection.
struct SetSpacePivot {
  std::optional<Vec3> pivot;
};
/// Sets the axis about which a selection of a volume mesh rotates.
struct SetSpaceAxis {
  Vec3 axis{0, 0, 1};
};
/// Sets pivot and axis from nodes picked in a volume mesh.
struct TakePivot {
  PivotSource source;
};
/// Makes the next click in a volume mesh pick a pivot: from a node, an edge, a face, or two nodes,
/// of which `first` is already picked. none: cancels this.
struct PickPivot {
  std::optional<PivotFrom> from;
  std::optional<Index> first = {};
};
struct SelectArc {
  std::optional<BoundaryArc> arc;
};
/// Selects nodes of a volume mesh for dragging; none: clears the patch.
struct SelectPatch {
  std::optional<SurfacePatch> patch;
};
/// Shows a deformation of the selected bodies as an outline; none: ends the preview.
struct PreviewDeformation {
  std::optional<SineDeformation> shape;
};
/// Shows a rigid motion of the selected bodies as an outline; none: ends the preview.
struct PreviewMotion {
  std::optional<RigidMotion> motion;
};
/// Lists the selected bodies with a motion, to move together with others; a listed body gets
/// another motion. A motion without a pivot turns about the centre of what moves.
struct PlanBody {
  RigidMotion motion;
};
/// Takes a body out of this list.
struct UnplanBody {
  std::size_t number = 0;
};
struct ClearBodyPlan {};
/// Selects the node to inspect; none: no node.
struct SelectNode {
  std::optional<Index> node;
};
struct HoverNode {
  std::optional<Index> node;
};
struct PinNodes {
  std::vector<Index> nodes;
  bool pinned = true;  ///< false: unpin them
};

/// Changes of virtual control volumes. Carried out by VcvEditor.

/// Changes VCVs and smooths. under_mouse: until EndVcvEdit, the mesh follows every further
/// EditVcvs, which replaces the previous edits.
struct EditVcvs {
  std::vector<VcvEdit> edits;
  bool under_mouse = false;
};
struct EndVcvEdit {};
struct CancelVcvEdit {};

}  // namespace winslow::gui::action

namespace winslow::gui {

using FileAction = std::variant<action::OpenMesh, action::SaveMesh, action::CloseMesh,
                                action::ExportMesh, action::ExportMarkers, action::ExportRecipe,
                                action::ExportConvergence, action::Quit>;
using HistoryAction = std::variant<action::Undo, action::Redo, action::GoToStep, action::EditStep,
                                   action::DeleteStep, action::BringBack, action::ReplayRecipe>;
using JobAction =
    std::variant<action::RunSmooth, action::Scramble, action::PauseSolver, action::ResumeSolver,
                 action::StepSolver, action::CancelSolver, action::SetPace, action::FollowSolver,
                 action::RunCommand, action::RerunStep>;

using SettingsAction =
    std::variant<action::EditSmoothOptions, action::EditMotionOptions, action::PairMarkers,
                 action::OverrideNode, action::StepOverride, action::ChooseReference>;

using LayerAction = std::variant<action::PreviewLayers>;
using MessageAction = std::variant<action::DismissPrompt, action::DismissBanner, action::Remark>;
using MotionAction =
    std::variant<action::ApplyMotion, action::ApplyDeformation, action::ApplyBodyPlan,
                 action::MoveNodesOfFile, action::SetShapeEdit, action::BeginDrag, action::DragTo,
                 action::EndDrag, action::CancelDrag>;
using SelectionAction =
    std::variant<action::SelectMarkers, action::HoverMarkers, action::SetPivot,
                 action::SetSpacePivot, action::SetSpaceAxis, action::TakePivot, action::PickPivot,
                 action::SelectArc, action::SelectPatch, action::PreviewDeformation,
                 action::PreviewMotion, action::PlanBody, action::UnplanBody, action::ClearBodyPlan,
                 action::SelectNode, action::HoverNode, action::PinNodes>;
using VcvAction = std::variant<action::EditVcvs, action::EndVcvEdit, action::CancelVcvEdit>;

/// Passes an action to its handler's function void on(const A&). An action without such a function
/// does not compile. Neither does a handler whose on() accepts any type: unhandled actions would go
/// unnoticed.
class Dispatch {
  struct NoAction {};
  // The type must match exactly: an action must not reach a function through a conversion.
  template <class Handler, class A>
  static constexpr bool takes = requires {
    static_cast<void (Handler::*)(const A&)>(&Handler::on);
  };
  template <class Handler>
  static constexpr bool takes_anything = requires(Handler& handler, const NoAction& nothing) {
    handler.on(nothing);
  };
  template <class Handler, class... As>
  static constexpr bool takes_all(const std::variant<As...>* /*actions*/) {
    return (takes<Handler, As> && ...) && !takes_anything<Handler>;
  }

 public:
  template <class Handler, class... As>
  static void to(Handler& handler, const std::variant<As...>& action) {
    static_assert(!takes_anything<Handler>, "on() takes what is no action at all");
    static_assert((takes<Handler, As> && ...), "an action that the handler has no on() for");
    std::visit([&handler](const auto& a) { handler.on(a); }, action);
  }

  /// True if `Handler` has a function on() for every alternative of the variant `Actions`, and none
  /// that accepts any type.
  template <class Handler, class Actions>
  static constexpr bool complete() {
    return takes_all<Handler>(static_cast<const Actions*>(nullptr));
  }
};

}  // namespace winslow::gui
