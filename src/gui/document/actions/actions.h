#pragma once

#include <chrono>

#include "core/mesh/mesh.h"
#include "core/types.h"
#include "gui/base/screen.h"
#include "gui/document/actions/document_actions.h"
#include "gui/files/file_kinds.h"
#include "gui/settings/option_edits.h"
#include "gui/settings/picture_spec.h"
#include "gui/settings/view_state.h"

/// Requests of the user. Panels and the viewport emit actions; the class named above each group
/// carries them out. Nothing else changes the state of the studio.
///
/// TO ADD AN ACTION, add it to its group and to the variant of that name: in document_actions.h if
/// it concerns only the open mesh, otherwise here. It compiles once its handler has a function on()
/// for it (see Dispatch).
namespace winslow::gui {

/// The parts of the mesh at a clicked place of the screen.
struct PickedPlace {
  std::optional<Vec2> point;     ///< units of the mesh; none: the click was on a row of a list
  std::vector<Index> markers;    ///< markers of the body there, ascending; empty: none
  std::optional<Index> node;     ///< node near enough to the click
  std::optional<Index> element;  ///< element that contains the point
  /// Volume mesh: the point and the normal of the surface there, towards the viewer.
  std::optional<std::array<Vec3, 2>> in_space = {};
  std::optional<Index> face = {};  ///< boundary face of a volume mesh, numbered as in Topology
};

}  // namespace winslow::gui

namespace winslow::gui::action {

/// Camera and drawing options. Carried out by Navigator and ViewControl.

/// Sets some of the view's options and leaves the others unchanged.
struct EditView {
  OptionEdit<ViewOptions> edit;
};
struct FitView {};
struct FitSelection {};
/// Shows all holes of the mesh.
struct FitBodies {};
struct FitMarkers {
  std::vector<Index> markers;
};
/// Switches the ruler, with which clicks measure, on or off.
struct ToggleRuler {};
struct LookAt {
  Vec3 point;         ///< z = 0 in the plane
  double radius = 0;  ///< of the region shown around the point, in units of the mesh
};
/// The next drag of the mouse draws the box to zoom to; a second action cancels this.
struct BoxZoom {};
/// Enlarges a box of the screen until it fills the view.
struct ZoomToScreen {
  ScreenBox box;
  Vec3 depth;  ///< a point at the depth of the objects to zoom to
};
/// Looks at a volume mesh from a named direction, see named_view().
struct LookFrom {
  std::string name;
};
/// Sets the view and the cuts of a volume mesh.
struct ShowLook {
  SpaceLook look;
};
/// Adds a cut through the centre of the view, normal to the axis that points most towards the
/// viewer.
struct AddCutAcrossView {};
/// Gives a cut a handle in the picture; none: no cut has a handle.
struct HoldCut {
  std::optional<std::size_t> cut;
};
/// Adds a cutting plane to a volume mesh; the side that the normal points to is removed.
struct AddCut {
  Vec3 point, normal;
};
struct BackView {};
struct ForwardView {};
/// Highlights a node or an element and centres the view on it; none: clears the highlight.
struct GoTo {
  std::optional<MeshItem> item;
  bool centre = true;  ///< false: the view does not move
};
/// Selects a node, shows it in the inspector and moves the view to it if necessary.
struct InspectNode {
  std::optional<Index> node;
};
/// Pins the magnifier to the place under the mouse; a pinned magnifier is switched off.
struct PinMagnifier {};
/// Gives the keyboard focus to the field "Go to".
struct AskGoTo {};
/// Shows the roles of nodes in smoothing regardless of the view's options, or stops showing them.
struct PreviewRoles {
  bool on = false;
};
/// Steps the scale of the interface up (1), down (-1), or back to that of the screen (0).
struct StepScale {
  int by = 0;
};

/// Pictures and recordings. Carried out by Capture.

/// Saves a picture of the window at its present size.
struct TakeScreenshot {
  std::filesystem::path path;  ///< empty: a new name in the working folder
  bool overwrite = false;
};
/// Replaces all settings of pictures by those of an accepted dialog.
struct SetPictureSpec {
  PictureSpec spec;
};
/// Saves a picture with the settings of SetPictureSpec: .png, or the mesh alone as .svg or .pdf.
struct SavePicture {
  std::filesystem::path path;
  bool overwrite = false;
};
/// Replaces all settings of recordings, see SetPictureSpec.
struct SetRecordingSpec {
  RecordingSpec spec;
};
/// Starts to record the mesh, with the settings of SetRecordingSpec.
struct StartRecording {
  std::filesystem::path path;       ///< .mp4 or .gif: a film; otherwise a folder of PNG frames
  std::optional<std::size_t> step;  ///< step of the history to rerun and record
  bool overwrite = false;
};
struct StopRecording {};    ///< writes the recording
struct CancelRecording {};  ///< discards the recording

/// Dialogs to open. Carried out by Dialogs.

struct ShowFileDialog {
  FilePurpose purpose = FilePurpose::open_mesh;
  std::string extension = {};  ///< ".vtu": of the suggested name; empty: unchanged
  bool proceed = false;        ///< when saving a mesh: see action::SaveMesh
};
struct ShowPictureDialog {};
struct ShowRecordDialog {
  std::optional<std::size_t> step;  ///< see StartRecording
};
struct ShowStepEditor {
  std::size_t position = 0;
};
/// Sets the file of the surface on which nodes slide in the step being edited.
struct ChooseStepReference {
  std::filesystem::path file;
};
/// Opens the context menu beside the mouse.
struct ShowContextMenu {
  PickedPlace place;
};
struct ShowHelp {};
struct ShowPalette {};
struct ShowAbout {};

/// The welcome page and the data kept between runs. Carried out by the workbench.

/// Shows or hides the page of recent and bundled meshes.
struct ShowWelcome {};
struct ClearRecent {};
/// Gives the keyboard focus to a field of the left column; opens the column and unfolds the
/// section. A name that ends in "/" is the name of a section, which is unfolded.
struct EditField {
  std::string field;  ///< id of the widget: "motion/rotate"
};
/// Copies a text to the clipboard.
struct CopyText {
  std::string text;
};
struct RestoreSession {
  std::filesystem::path folder;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
};
struct DiscardSession {
  std::filesystem::path folder;
};

/// Guided demos. Carried out by DemoPlayer through the workbench.

struct StartDemo {
  std::string id;
  bool discard_changes = false;  ///< false: ask if the open mesh has unsaved changes
};
/// Goes to the next step or, with -1, to the previous one.
struct StepDemo {
  int by = 1;
};
/// Advances automatically, or waits at each step.
struct PlayDemo {
  bool automatic = true;
};
struct EndDemo {};

}  // namespace winslow::gui::action

namespace winslow::gui {

/// Actions that move the camera.
using CameraAction = std::variant<action::FitView, action::FitSelection, action::FitBodies,
                                  action::FitMarkers, action::LookAt, action::ZoomToScreen,
                                  action::LookFrom, action::BackView, action::ForwardView>;

/// Actions on what is drawn and on the inspected items.
using ViewAction =
    std::variant<action::EditView, action::ToggleRuler, action::BoxZoom, action::GoTo,
                 action::InspectNode, action::PinMagnifier, action::AskGoTo, action::PreviewRoles,
                 action::StepScale, action::AddCut, action::HoldCut, action::AddCutAcrossView,
                 action::ShowLook>;
using PictureAction =
    std::variant<action::TakeScreenshot, action::SetPictureSpec, action::SavePicture,
                 action::SetRecordingSpec, action::StartRecording, action::StopRecording,
                 action::CancelRecording>;
using DialogAction =
    std::variant<action::ShowFileDialog, action::ShowPictureDialog, action::ShowRecordDialog,
                 action::ShowStepEditor, action::ChooseStepReference, action::ShowContextMenu,
                 action::ShowHelp, action::ShowPalette, action::ShowAbout>;
using ShellAction = std::variant<action::ShowWelcome, action::ClearRecent, action::EditField,
                                 action::CopyText, action::RestoreSession, action::DiscardSession>;
using DemoAction =
    std::variant<action::StartDemo, action::StepDemo, action::PlayDemo, action::EndDemo>;

/// Actions on the open mesh, which need no window.
using DocumentAction = std::variant<FileAction, SelectionAction, MotionAction, VcvAction, JobAction,
                                    SettingsAction, LayerAction, HistoryAction, MessageAction>;

using Action = std::variant<DocumentAction, CameraAction, ViewAction, PictureAction, DialogAction,
                            ShellAction, DemoAction>;

using ActionQueue = std::vector<Action>;

/// A question or an error that waits for an answer.
struct Prompt {
  enum class Kind { error, question, information };
  struct Choice {
    std::string label;
    ActionQueue actions;  ///< carried out for this choice; any choice closes the prompt
    bool primary = false;
  };
  Kind kind = Kind::information;
  std::string title;
  std::string text;
  std::vector<Choice> choices;
};

/// A warning about the state of the present mesh, shown above it until resolved or dismissed.
struct Banner {
  enum class Kind {
    inverted_result,
    inverted_input,
    not_converged,
    partial_motion,
    damaged,
    remark
  };
  Kind kind = Kind::inverted_result;
  std::string text;
  std::optional<MeshItem> worst = {};  ///< its place, if it concerns one
};

/// A short-lived message about the last operation.
struct Notice {
  enum class Kind { information, success, warning };
  Kind kind = Kind::information;
  std::string text;
  std::chrono::steady_clock::time_point since;
};

}  // namespace winslow::gui
