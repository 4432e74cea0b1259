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

/// What a user can ask for. Panels and the viewport emit actions; those who are named above each
/// group carry them out. Nothing else changes the state of the studio.
///
/// TO ADD AN ACTION, add it to its group and to the variant of that name, which stand here or, if
/// it is of the open mesh alone, in document_actions.h. It compiles once its handler has a function
/// on() for it (see Dispatch).
namespace winslow::gui {

/// What lies at a place of the mesh on screen, as a click there means it.
struct PickedPlace {
  std::optional<Vec2> point;     ///< units of the mesh; none: a row of a list was clicked
  std::vector<Index> markers;    ///< of the body there, ascending; empty: none
  std::optional<Index> node;     ///< near enough to be meant
  std::optional<Index> element;  ///< that contains the point
  /// Of a volume mesh, with the normal of the surface there, towards the viewer.
  std::optional<std::array<Vec3, 2>> in_space = {};
  std::optional<Index> face = {};  ///< of the boundary of a volume mesh, as Topology numbers them
};

}  // namespace winslow::gui

namespace winslow::gui::action {

/// Where the user looks and what is drawn. Carried out by Navigator and ViewControl.

/// Sets some of the view's options and leaves the others as they are.
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
/// Clicks measure from now on, or no longer.
struct ToggleRuler {};
struct LookAt {
  Vec3 point;         ///< z = 0 in the plane
  double radius = 0;  ///< shown around the point, in units of the mesh
};
/// The next drag of the mouse draws the box to zoom to; again: it does not.
struct BoxZoom {};
/// Shows what lies in a box of the screen, as large as there is room for.
struct ZoomToScreen {
  ScreenBox box;
  Vec3 depth;  ///< a point as deep as what is meant
};
/// Looks at a volume mesh from a direction with a name, as named_view() knows it.
struct LookFrom {
  std::string name;
};
/// Looks at a volume mesh, and cuts it, as is said.
struct ShowLook {
  SpaceLook look;
};
/// The same through what is in the middle of the view, across the axis that points to the viewer
/// most.
struct AddCutAcrossView {};
/// Gives a cut a handle in the picture; none: none has one.
struct HoldCut {
  std::optional<std::size_t> cut;
};
/// Cuts a volume mesh by one more plane; what the normal points to is taken away.
struct AddCut {
  Vec3 point, normal;
};
struct BackView {};
struct ForwardView {};
/// Highlights a node or an element and centres it; none: nothing is highlighted any more.
struct GoTo {
  std::optional<MeshItem> item;
  bool centre = true;  ///< false: the view stays where it is
};
/// Selects a node, shows it in the inspector and brings it into sight.
struct InspectNode {
  std::optional<Index> node;
};
/// Pins the magnifier to the place under the mouse; pinned, it is put away.
struct PinMagnifier {};
/// Puts the keyboard into the field "Go to".
struct AskGoTo {};
/// Shows what nodes do while the mesh is smoothed, whatever the view's options are; or no longer.
struct PreviewRoles {
  bool on = false;
};
/// Steps the scale of the interface up (1) or down (-1), or back to the screen's own (0).
struct StepScale {
  int by = 0;
};

/// Pictures and recordings. Carried out by Capture.

/// The window as it is.
struct TakeScreenshot {
  std::filesystem::path path;  ///< empty: a new name in the working folder
  bool overwrite = false;
};
/// The whole of the settings, as a dialog that was accepted has them.
struct SetPictureSpec {
  PictureSpec spec;
};
/// A picture by the settings of SetPictureSpec: .png, or the mesh alone as .svg or .pdf.
struct SavePicture {
  std::filesystem::path path;
  bool overwrite = false;
};
/// As SetPictureSpec.
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

/// Dialogs that come up. Carried out by Dialogs.

struct ShowFileDialog {
  FilePurpose purpose = FilePurpose::open_mesh;
  std::string extension = {};  ///< ".vtu": of the name to start with; empty: as it is
  bool proceed = false;        ///< of a mesh to be saved: as action::SaveMesh
};
struct ShowPictureDialog {};
struct ShowRecordDialog {
  std::optional<std::size_t> step;  ///< as StartRecording
};
struct ShowStepEditor {
  std::size_t position = 0;
};
/// The surface in a file, for nodes to slide on in the step that is being edited.
struct ChooseStepReference {
  std::filesystem::path file;
};
/// The menu of a right click, beside the mouse.
struct ShowContextMenu {
  PickedPlace place;
};
struct ShowHelp {};
struct ShowPalette {};
struct ShowAbout {};

/// The studio's first page and what outlives the studio. Carried out by the workbench.

/// The page of recent and bundled meshes comes, or goes.
struct ShowWelcome {};
struct ClearRecent {};
/// Puts the keyboard into a field of the column on the left, which comes up and unfolds for it. A
/// name that ends in "/" is that of the section of such fields: it unfolds.
struct EditField {
  std::string field;  ///< id of the widget: "motion/rotate"
};
/// Puts a text where other programs can paste it.
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

/// Where the camera goes.
using CameraAction = std::variant<action::FitView, action::FitSelection, action::FitBodies,
                                  action::FitMarkers, action::LookAt, action::ZoomToScreen,
                                  action::LookFrom, action::BackView, action::ForwardView>;

/// What is drawn, and what that is about.
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

/// Actions on the open mesh; they need no window.
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
    ActionQueue actions;  ///< carried out when it is chosen; the prompt goes in any case
    bool primary = false;
  };
  Kind kind = Kind::information;
  std::string title;
  std::string text;
  std::vector<Choice> choices;
};

/// What the present mesh's state calls for, shown above it until it is dealt with.
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
  std::optional<MeshItem> worst = {};  ///< where to look, if it is about a place
};

/// A passing remark: what was just done.
struct Notice {
  enum class Kind { information, success, warning };
  Kind kind = Kind::information;
  std::string text;
  std::chrono::steady_clock::time_point since;
};

}  // namespace winslow::gui
