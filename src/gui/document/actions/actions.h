#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/command/command.h"
#include "gui/document/selection/body_anchors.h"
#include "gui/document/selection/shape_edit.h"
#include "gui/files/file_kinds.h"
#include "gui/settings/picture_spec.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

/// What a user can ask for. Panels and the viewport emit actions; the session and the workbench
/// carry them out. Nothing else changes the state of the studio.
namespace winslow::gui::action {

// Files
struct OpenMesh {
  std::filesystem::path path;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
};
struct SaveMesh {
  std::filesystem::path path;   ///< empty: where the mesh came from
  bool overwrite = false;       ///< false: ask if the file exists
  bool allow_inverted = false;  ///< false: ask if the mesh has inverted elements
};
struct ExportRecipe {
  std::filesystem::path path;
  bool overwrite = false;
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
/// Writes markers as curves (io/boundary_file.h).
struct ExportMarkers {
  std::filesystem::path path;
  std::vector<Index> markers;  ///< empty: those selected or, without a selection, all
  bool overwrite = false;
};
struct ClearRecent {};
struct Quit {
  bool discard_changes = false;
};

// Bodies and their motion
struct SelectMarkers {
  std::vector<Index> markers;
  bool toggle = false;  ///< true: add or remove; false: select these alone
};
struct HoverMarkers {
  std::vector<Index> markers;
};
/// Selects the next body in the flow, or the one before.
struct CycleBody {
  int step = 1;
};
struct SetPivot {
  std::optional<Vec2> pivot;  ///< none: at the place named
  PivotPlace place = PivotPlace::centre;
};
struct ApplyMotion {
  RigidMotion motion;
};
/// A motion under the mouse: the mesh follows every DragTo until EndDrag. Motions are total, seen
/// from BeginDrag.
struct BeginDrag {
  bool shape = false;  ///< the arc of the shape edit instead of the selected bodies
};
struct DragTo {
  RigidMotion motion;
};
struct EndDrag {};
struct CancelDrag {};
struct SetMotionOptions {
  MotionOptions options;
};
/// Shape editing on or off, and how far a drag fades along the boundary, units of the mesh.
struct SetShapeEdit {
  bool active = false;
  double radius = 0;
};
struct SelectArc {
  std::optional<BoundaryArc> arc;
};
/// A deformation of the selected bodies, shown as an outline only; none: no more.
struct PreviewDeformation {
  std::optional<SineDeformation> shape;
};
struct ApplyDeformation {
  SineDeformation shape;
};
/// Layers of the mesh, planned and shown but not inserted; none: no more.
struct PreviewLayers {
  std::optional<LayerOptions> options;
};

// Nodes and their virtual control volumes
struct InspectNode {
  std::optional<Index> node;
};
struct HoverNode {
  std::optional<Index> node;
};
struct PinNodes {
  std::vector<Index> nodes;
  bool pinned = true;  ///< false: take the pins away
};
/// Changes VCVs and smooths. under_mouse: the mesh follows every further EditVcvs, which replaces
/// the edits before, until EndVcvEdit.
struct EditVcvs {
  std::vector<VcvEdit> edits;
  bool under_mouse = false;
};
struct EndVcvEdit {};
struct CancelVcvEdit {};

// Solver
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
struct SetSmoothOptions {
  SmoothOptions options;
};
/// How fast the outer iterations of the direct method go by.
struct SetPace {
  double iterations_per_second = 0;  ///< 0: as fast as they come
};
/// Any command, as a recipe has it.
struct RunCommand {
  Command command;
  bool paused = false;  ///< wait before the first iteration
};
/// Carries out a command of the history again, from the mesh it found, to be watched; paused at
/// first. The history stays what it is.
struct RerunStep {
  std::size_t position = 1;  ///< as History::command()
};

// History
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
  std::size_t kept = 0;  ///< index into Document::kept()
};
/// Applies the commands of a recipe to the open mesh, one after the other.
struct ReplayRecipe {
  std::filesystem::path path;
};
/// Writes the iterations that the convergence plot shows as CSV.
struct ExportConvergence {
  std::filesystem::path path;
  bool overwrite = false;
};
struct ShowStepEditor {
  std::size_t position = 0;
};

// Sessions that outlived a crash
struct RestoreSession {
  std::filesystem::path folder;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
};
struct DiscardSession {
  std::filesystem::path folder;
};

// Messages
struct DismissPrompt {};
struct DismissBanner {};

// View
struct SetView {
  ViewOptions view;
};
struct FitView {};
struct FitSelection {};
struct LookAt {
  Vec2 point;
  double radius = 0;  ///< shown around the point, in units of the mesh
};
/// The next drag of the mouse draws the box to zoom to; again: it does not.
struct BoxZoom {};
struct ZoomTo {
  Bounds box;  ///< fills the viewport
};
struct BackView {};
struct ForwardView {};
/// Highlights a node or an element and centres it; none: nothing is highlighted any more.
struct GoTo {
  std::optional<MeshItem> item;
};
/// Pins the magnifier to the place under the mouse; pinned, it is put away.
struct PinMagnifier {};
/// Puts the keyboard into the field "Go to".
struct AskGoTo {};
/// Steps the scale of the interface up (1) or down (-1), or back to the screen's own (0).
struct StepScale {
  int by = 0;
};
struct ShowFileDialog {
  FilePurpose purpose = FilePurpose::open_mesh;
  std::string extension = {};  ///< ".vtu": of the name to start with; empty: as it is
};
/// The window as it is.
struct TakeScreenshot {
  std::filesystem::path path;  ///< empty: a new name in the working folder
  bool overwrite = false;
};
struct SetPictureSpec {
  PictureSpec spec;
};
/// A picture by the settings of SetPictureSpec: .png, or the mesh alone as .svg or .pdf.
struct SavePicture {
  std::filesystem::path path;
  bool overwrite = false;
};
struct ShowPictureDialog {};
struct SetRecordingSpec {
  RecordingSpec spec;
};
/// Records the mesh from now on, by the settings of SetRecordingSpec.
struct StartRecording {
  std::filesystem::path path;       ///< .mp4 or .gif: a film; else a folder of PNG frames
  std::optional<std::size_t> step;  ///< carry out this step of the history again, and record that
  bool overwrite = false;
};
struct StopRecording {};    ///< what was recorded is written
struct CancelRecording {};  ///< what was recorded is thrown away
struct ShowRecordDialog {
  std::optional<std::size_t> step;  ///< as StartRecording
};
struct ShowHelp {};
struct ShowPalette {};
struct ShowWelcome {};
struct ShowAbout {};

// Guided demos
struct StartDemo {
  std::string id;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
};
/// To the next step or, with -1, back to the one before.
struct StepDemo {
  int by = 1;
};
/// Goes on by itself, or waits at each step.
struct PlayDemo {
  bool automatic = true;
};
struct EndDemo {};

}  // namespace winslow::gui::action

namespace winslow::gui {

// A group a line, as above.
// clang-format off
using Action = std::variant<
    // Files
    action::OpenMesh, action::SaveMesh, action::ExportRecipe, action::CloseMesh,
    action::ExportMesh, action::ExportMarkers, action::ClearRecent, action::Quit,
    // Bodies and their motion
    action::SelectMarkers, action::HoverMarkers, action::CycleBody, action::SetPivot,
    action::ApplyMotion, action::SetShapeEdit, action::SelectArc, action::PreviewDeformation,
    action::ApplyDeformation, action::PreviewLayers,
    action::BeginDrag, action::DragTo, action::EndDrag, action::CancelDrag,
    action::SetMotionOptions,
    // Nodes and their virtual control volumes
    action::InspectNode, action::HoverNode, action::PinNodes, action::EditVcvs,
    action::EndVcvEdit, action::CancelVcvEdit,
    // Solver
    action::RunSmooth, action::Scramble, action::PauseSolver, action::ResumeSolver,
    action::StepSolver, action::CancelSolver, action::SetSmoothOptions, action::SetPace,
    action::RunCommand, action::RerunStep,
    // History
    action::Undo, action::Redo, action::GoToStep, action::EditStep, action::DeleteStep,
    action::BringBack, action::ReplayRecipe, action::ExportConvergence, action::ShowStepEditor,
    // Sessions that outlived a crash
    action::RestoreSession, action::DiscardSession,
    // Messages
    action::DismissPrompt, action::DismissBanner,
    // View
    action::SetView, action::FitView, action::FitSelection, action::LookAt, action::BoxZoom,
    action::ZoomTo,    action::BackView, action::ForwardView, action::GoTo, action::AskGoTo, action::PinMagnifier, action::StepScale,
    // Pictures and dialogs
    action::ShowFileDialog, action::TakeScreenshot, action::SetPictureSpec, action::SavePicture,
    action::ShowPictureDialog, action::SetRecordingSpec, action::StartRecording,
    action::StopRecording, action::CancelRecording, action::ShowRecordDialog, action::ShowHelp,
    action::ShowPalette,
    action::ShowWelcome, action::ShowAbout,
    // Guided demos
    action::StartDemo, action::StepDemo, action::PlayDemo, action::EndDemo>;
// clang-format on

using ActionQueue = std::vector<Action>;

}  // namespace winslow::gui
