#pragma once

#include <filesystem>

#include "core/command/command.h"
#include "core/motion/motion.h"
#include "core/motion/rigid_motion.h"
#include "core/types.h"
#include "gui/document/selection/boundary_index.h"
#include "gui/document/selection/node_overrides.h"
#include "gui/document/selection/pivot.h"
#include "gui/settings/option_edits.h"

namespace winslow::gui::action {

/// Opening, saving and exporting. Carried out by Files.

struct OpenMesh {
  std::filesystem::path path;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
  int zone = 0;                  ///< of a file of several zones; 0: the first
};
struct SaveMesh {
  std::filesystem::path path;   ///< empty: where the mesh came from
  bool overwrite = false;       ///< false: ask if the file exists
  bool allow_inverted = false;  ///< false: ask if the mesh has inverted elements
  /// Go on with what Files::ask_to_save() was called for, once the mesh is saved.
  bool proceed = false;
};
/// Closes the open mesh.
struct CloseMesh {
  bool discard_changes = false;  ///< false: ask if it has unsaved changes
};
/// Writes a copy: the open mesh stays the one it is, saved or not.
struct ExportMesh {
  std::filesystem::path path;
  bool overwrite = false;
};
/// Writes markers as curves (io/tables/table_files.h).
struct ExportMarkers {
  std::filesystem::path path;
  std::vector<Index> markers;  ///< empty: those selected or, without a selection, all
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
/// Another command in the place of one that was carried out; those after it are run again.
struct EditStep {
  std::size_t position = 0;
  Command command;
};
/// Takes a command out; those after it are run again.
struct DeleteStep {
  std::size_t position = 0;
};
/// Puts a history back that an edit replaced; the present one is kept in its place.
struct BringBack {
  std::size_t kept = 0;  ///< index into EditHistory::kept()
};
/// Applies the commands of a recipe to the open mesh, one after the other.
struct ReplayRecipe {
  std::filesystem::path path;
};

/// The solver: what it carries out, how, and the layers that it is to insert. Carried out by Jobs,
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
/// Has the nodes of two markers move together, as periodic sides, or those of `first` with none (no
/// second): in every run from here on.
struct PairMarkers {
  std::string first;
  std::optional<std::string> second;
};
/// Has a node of the boundary stay, or slide, in every run from here on, whatever was found of it.
/// Undo takes it back.
struct OverrideNode {
  Index node = 0;
  NodeOverride to = NodeOverride::none;
};
/// Takes back what was last told to a node at this mesh, or tells it again.
struct StepOverride {
  bool again = false;
};
/// The surface in a file, for nodes to slide on in every run from here on instead of the mesh's
/// own. It is read first; a file that cannot be read changes nothing.
struct ChooseReference {
  std::filesystem::path file;  ///< empty: none, the mesh's own
};
/// How fast the outer iterations of the direct method go by.
struct SetPace {
  double iterations_per_second = 0;  ///< 0: as fast as they come
};
/// The solver waits after every iteration until this comes again: someone records them all.
struct FollowSolver {
  bool on = true;
};
/// Any command, as a recipe has it.
struct RunCommand {
  Command command;
  bool paused = false;  ///< wait before the first iteration
  /// What it does to a mesh that has no changes is no work of the user's, which would have to be
  /// saved: a step of a demo.
  bool shown_only = false;
};
/// Carries out a command of the history again, from the mesh it found, to be watched; paused at
/// first. The history stays what it is.
struct RerunStep {
  std::size_t position = 1;  ///< as History::command()
};
/// Layers of the mesh, planned and shown but not inserted; none: no more.
struct PreviewLayers {
  std::optional<LayerOptions> options;
};

/// Answers to what the studio says. Carried out by MessageBoard.

struct DismissPrompt {};
struct DismissBanner {};
/// A passing remark on what the user has just tried.
struct Remark {
  std::string text;
};

/// Motions and changes of shape, typed or under the mouse. Carried out by Motions.

/// In the plane or in space, as the open mesh is.
struct ApplyMotion {
  RigidMotion motion;
};
struct ApplyDeformation {
  SineDeformation shape;
};
/// Shape editing on or off, and how far a drag fades along the boundary, units of the mesh.
struct SetShapeEdit {
  bool active = false;
  double radius = 0;
};
/// A motion under the mouse: the mesh follows every DragTo until EndDrag. Motions are total, seen
/// from BeginDrag.
struct BeginDrag {
  bool shape = false;  ///< the arc or patch of the shape edit instead of the selected bodies
};
struct DragTo {
  RigidMotion motion;  ///< as the open mesh is; it names its pivot
};
struct EndDrag {};
struct CancelDrag {};

/// What is selected, hovered, pinned and inspected. Carried out by Selection.

struct SelectMarkers {
  std::vector<Index> markers;
  bool toggle = false;  ///< true: add or remove; false: select these alone
};
struct HoverMarkers {
  std::vector<Index> markers;
};
struct SetPivot {
  std::optional<Vec2> pivot;  ///< none: at the place named
  PivotPlace place = PivotPlace::centre;
};
/// The same of a volume mesh; none: at the centre of what is selected.
struct SetSpacePivot {
  std::optional<Vec3> pivot;
};
/// The axis about which a selection of a volume mesh turns.
struct SetSpaceAxis {
  Vec3 axis{0, 0, 1};
};
/// Pivot and axis from what was picked in a volume mesh.
struct TakePivot {
  PivotSource source;
};
/// The next click in a volume mesh picks a pivot from a node, an edge, a face, or from two nodes,
/// of which `first` is taken; none: no more.
struct PickPivot {
  std::optional<PivotFrom> from;
  std::optional<Index> first = {};
};
struct SelectArc {
  std::optional<BoundaryArc> arc;
};
/// Nodes of a volume mesh that are held to be dragged; none: no more.
struct SelectPatch {
  std::optional<SurfacePatch> patch;
};
/// A deformation of the selected bodies, shown as an outline only; none: no more.
struct PreviewDeformation {
  std::optional<SineDeformation> shape;
};
/// A rigid motion of the selected bodies, shown as an outline only; none: no more.
struct PreviewMotion {
  std::optional<RigidMotion> motion;
};
/// Selects the node of the inspector; none: no node.
struct SelectNode {
  std::optional<Index> node;
};
struct HoverNode {
  std::optional<Index> node;
};
struct PinNodes {
  std::vector<Index> nodes;
  bool pinned = true;  ///< false: take the pins away
};

/// Changes of virtual control volumes. Carried out by VcvEditor.

/// Changes VCVs and smooths. under_mouse: the mesh follows every further EditVcvs, which replaces
/// the edits before, until EndVcvEdit.
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
    std::variant<action::ApplyMotion, action::ApplyDeformation, action::SetShapeEdit,
                 action::BeginDrag, action::DragTo, action::EndDrag, action::CancelDrag>;
using SelectionAction =
    std::variant<action::SelectMarkers, action::HoverMarkers, action::SetPivot,
                 action::SetSpacePivot, action::SetSpaceAxis, action::TakePivot, action::PickPivot,
                 action::SelectArc, action::SelectPatch, action::PreviewDeformation,
                 action::PreviewMotion, action::SelectNode, action::HoverNode, action::PinNodes>;
using VcvAction = std::variant<action::EditVcvs, action::EndVcvEdit, action::CancelVcvEdit>;

/// Hands an action to the object that carries it out: to its function void on(const A&). An action
/// without such a function does not compile, and neither does a handler that takes whatever it is
/// given: it would swallow actions that nobody handles.
class Dispatch {
  struct NoAction {};
  // By its exact type: an action must not reach a function through a conversion.
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

  /// `Handler` has a function on() for every alternative of the variant `Actions`, and for nothing
  /// else.
  template <class Handler, class Actions>
  static constexpr bool complete() {
    return takes_all<Handler>(static_cast<const Actions*>(nullptr));
  }
};

}  // namespace winslow::gui
