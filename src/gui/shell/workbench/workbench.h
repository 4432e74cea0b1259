#pragma once

#include "gui/demos/demo_player.h"
#include "gui/document/autosave/autosave.h"
#include "gui/document/session/session.h"
#include "gui/picture/capture/capture.h"
#include "gui/settings/settings.h"
#include "gui/shell/workbench/dialogs.h"
#include "gui/shell/workbench/picture_painter.h"
#include "gui/shell/workbench/regions.h"
#include "gui/shell/workbench/viewport_pane.h"
#include "gui/shell/workbench/workbench_parts.h"
#include "gui/view/navigation/view_control.h"

namespace winslow::gui {

struct WorkbenchOptions {
  float scale = 1;  ///< pixels per unit of the layout
  /// Folder of data kept between runs: settings, recent files, the autosaved session. Empty:
  /// nothing is read or written.
  std::filesystem::path profile;
  /// Folder of the meshes for guided demos. Empty: the bundled meshes.
  std::filesystem::path demo_meshes = {};
};

/// The studio without its window: turns input into frames. The window, the headless studio and the
/// tests all use this class. Always needs a current OpenGL context.
class Workbench {
 public:
  explicit Workbench(const WorkbenchOptions& options = {});
  /// Removes the autosaved session if the user has quit, and keeps it otherwise.
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  /// Sets the screen's preferred pixels per unit of the layout; the user can choose another scale.
  void set_scale(float scale) { view_control_.scale().set_screen(scale); }
  void apply(const Action& action);

  /// Updates one frame: takes input for it from the queue, collects the threads' results, lays out
  /// the interface. A key waits until the mesh resulting from the last key was shown. width,
  /// height: framebuffer pixels. seconds: since the last frame.
  void update(InputQueue& queue, int width, int height, double seconds);
  /// Draws the last updated frame into the bound framebuffer.
  void paint() { pictures_.paint_window(); }

  /// Collects the threads' results. True if a new frame would look different.
  bool poll();
  /// True if no work is in progress and the colours on screen match the mesh on screen.
  bool settled() const;

  const Session& session() const { return session_; }
  const ViewControl& view_control() const { return view_control_; }
  const ViewportPane& pane() const { return pane_; }
  ViewportPane& pane() { return pane_; }
  const Regions& regions() const { return regions_; }
  const Layout& layout() const { return window_.layout; }
  const Theme& theme() const { return window_.ui.theme(); }
  /// Positions of the widgets of the last frame.
  const WidgetMap& widgets() const { return window_.ui.widgets(); }
  WidgetMap& widgets() { return window_.ui.widgets(); }
  const Dialogs& dialogs() const { return dialogs_; }
  const Capture& capture() const { return capture_; }
  const DemoPlayer& demo() const { return demo_; }
  const RecentFiles& recent() const { return opened_files_.recent(); }
  const Autosave& autosave() const { return autosave_; }
  PicturePainter& pictures() { return pictures_; }
  /// The present settings, as they would be saved.
  Settings settings() const { return settings_of(view_control_, window_, opened_files_.recent()); }
  /// Shape of the mouse cursor (ImGuiMouseCursor).
  int cursor() const { return pane_.cursor().value_or(window_.ui.cursor()); }
  /// "* naca0012.su2 - winslow"
  std::string title() const;

  void on(const action::RestoreSession& a);
  void on(const action::DiscardSession& a) { autosave_.discard(a.folder); }
  void on(const action::ClearRecent&) { opened_files_.recent().clear(); }
  void on(const action::EditField& a);
  void on(const action::CopyText& a);
  /// The page closes when another mesh is opened.
  void on(const action::ShowWelcome&) { regions_.welcome().toggle(); }
  void on(const action::StartDemo& a);
  void on(const action::StepDemo& a) { demo_.go(a.by, session_, actions_); }
  void on(const action::PlayDemo& a) { demo_.play(a.automatic); }
  void on(const action::EndDemo&);

 private:
  void take_input(const InputState& input);
  void draw_window(const InputState& input);
  void dispatch();
  void finish_frame();
  void keep_settings(double seconds);
  PanelContext context() {
    return {session_,
            view_control_.options(),
            view_control_.state(),
            window_.ui.theme(),
            actions_,
            capture_,
            opened_files_.recent(),
            demo_,
            &pane_.before(),
            pane_.mesh_view().shown()};
  }

  void apply_group(const DocumentAction& action) { session_.apply(action); }
  void apply_group(const CameraAction& action) { view_control_.navigator().apply(action); }
  void apply_group(const ViewAction& action) { view_control_.apply(action); }
  void apply_group(const PictureAction& action) { capture_.apply(action); }
  void apply_group(const DialogAction& action) { dialogs_.apply(action); }
  void apply_group(const ShellAction& action) { Dispatch::to(*this, action); }
  void apply_group(const DemoAction& action) { Dispatch::to(*this, action); }

  std::filesystem::path demo_meshes_;  // empty: the bundled ones
  SettingsFile settings_file_;
  WindowFrame window_;
  Session session_;
  Autosave autosave_;
  Capture capture_{session_};
  ViewControl view_control_;
  ViewportPane pane_{session_, view_control_};
  Regions regions_;
  ActionQueue actions_;
  OpenedFiles opened_files_;
  DemoPlayer demo_;
  Dialogs dialogs_{session_};
  PicturePainter pictures_;
  KeyGate key_gate_;
};

}  // namespace winslow::gui
