#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "gui/demos/demo_player.h"
#include "gui/document/autosave/autosave.h"
#include "gui/document/session/session.h"
#include "gui/files/recent_files.h"
#include "gui/panels/layout.h"
#include "gui/panels/legend_card.h"
#include "gui/panels/welcome_panel.h"
#include "gui/picture/capture/capture.h"
#include "gui/picture/capture/picture_source.h"
#include "gui/render/camera.h"
#include "gui/render/image.h"
#include "gui/settings/settings.h"
#include "gui/shell/workbench/dialogs.h"
#include "gui/shell/workbench/panel_registry.h"
#include "gui/view/mesh/before_mesh.h"
#include "gui/view/mesh/mesh_view.h"
#include "gui/view/navigation/view_history.h"
#include "gui/view/overlays/id_labels.h"
#include "gui/view/tools/magnifier.h"
#include "gui/view/tools/node_tool.h"
#include "gui/view/tools/viewport.h"
#include "gui/widgets/ui_layer.h"

namespace winslow::gui {

struct WorkbenchOptions {
  float scale = 1;  ///< pixels per unit of the layout
  /// Folder for what outlives the studio: settings, recent files, the autosaved session. Empty:
  /// nothing is kept, nothing is read.
  std::filesystem::path profile;
  /// Folder of the meshes that guided demos open. Empty: the bundled meshes.
  std::filesystem::path demo_meshes = {};
};

/// The studio without its window: turns input into frames. The window, the headless screenshot and
/// the tests all drive this one class. Needs a current OpenGL context throughout.
class Workbench : public PictureSource {
 public:
  explicit Workbench(const WorkbenchOptions& options = {});
  /// What is kept for the case of a crash goes if the user had quit, and stays if not.
  ~Workbench() override;
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  /// Pixels per unit of the layout that the screen wants; the user may want another scale.
  void set_scale(float scale) { options_.scale = scale; }
  void apply(const Action& action);

  /// One frame: takes input, collects what threads have done, lays out the interface.
  /// width, height: framebuffer pixels. seconds: since the last frame.
  void update(const InputState& input, int width, int height, double seconds);
  /// Draws the frame last updated into the bound framebuffer.
  void paint();
  /// Draws the mesh anew next time, even if the picture of it that is kept would do.
  void forget_picture() { mesh_view_.forget_picture(); }
  /// The mesh is drawn, though perhaps without its colours yet.
  bool shows_mesh() const { return mesh_view_.has_mesh(); }
  /// It has its colours, too.
  bool shows_quality() const { return shows_mesh() && mesh_view_.legend().has_value(); }
  /// The frame last updated, drawn off-screen.
  Image picture() override;
  Image picture(const PictureSpec& spec) override;
  Vec2 picture_extent(const PictureSpec& spec) const override;
  VectorFigure figure(bool legend) const override;

  /// Collects what threads have done. True if a new frame would look different.
  bool poll();
  /// Nothing is under way and the colours on screen are those of the mesh on screen.
  bool settled() const;

  const Session& session() const { return session_; }
  const Capture& capture() const { return capture_; }
  const ViewOptions& view() const { return view_; }
  const ViewState& view_state() const { return view_state_; }
  /// As they would be kept now.
  Settings settings() const;
  const Camera& camera() const { return camera_; }
  /// What the mesh is compared with, as of the last frame.
  const BeforeMesh& before() const { return before_; }
  const Viewport& viewport() const { return viewport_; }
  /// What the mouse acts upon now.
  ViewportScene scene() const;
  const Layout& layout() const { return layout_; }
  const WidgetMap& widgets() const { return ui_->widgets(); }
  /// Scrolls a widget into sight in the frames to come; empty: no longer.
  void scroll_to(std::string_view widget) { ui_->widgets().want(widget); }
  const Autosave& autosave() const { return autosave_; }
  const FileDialog& file_dialog() const { return dialogs_.file_dialog(); }
  const PanelRegistry& panels() const { return panels_; }
  const RecentFiles& recent() const { return recent_; }
  const DemoPlayer& demo() const { return demo_; }
  const WelcomePanel& welcome() const { return welcome_; }
  /// Shape of the mouse cursor (ImGuiMouseCursor).
  int cursor() const;
  /// "* naca0012.su2 - winslow"
  std::string title() const;

 private:
  void take_input(const InputState& input);
  void draw_menu();
  void draw_regions();
  void draw_tabs();
  void draw_panels(Region region);
  void draw_splitters();
  void draw_viewport();
  void draw_recording();
  void drive_viewport(const InputState& input);
  void take_for_insets(PointerState& pointer);
  void release_lens();
  void draw_overlays(ImDrawList& list);
  void update_mesh_view();
  void draw_legend_card(ImDrawList& list);
  void paint_lens();
  bool shows_welcome() const;
  void draw_demo_card();
  void take_dropped(const InputState& input);
  void follow_files(double seconds);
  void dispatch();
  void finish_frame();
  PanelContext context() {
    return {session_, view_,   view_state_, ui_->theme(), actions_,
            capture_, recent_, demo_,       &before_};
  }
  float scale() const;
  float fitting_scale(double wanted) const;
  void take_settings(const Settings& settings);
  void keep_settings(double seconds);

  // Pictures at other sizes (workbench_pictures.cpp)
  struct Kept;
  Kept put_aside();
  void bring_back(Kept kept);
  void forget_pictures(double seconds);
  void lay_out_picture(const Bounds& visible);
  Image paint_tiles(bool transparent);
  std::optional<Inset> pinned_inset(const Camera& camera, double scale) const;

  friend class Dispatch;
  void apply_group(const DocumentAction& action) { session_.apply(action); }
  void apply_group(const ViewAction& action) { Dispatch::to(*this, action); }
  void apply_group(const PictureAction& action) { capture_.apply(action); }
  void apply_group(const DialogAction& action) { dialogs_.apply(action); }
  void apply_group(const ShellAction& action) { Dispatch::to(*this, action); }
  void apply_group(const DemoAction& action) { Dispatch::to(*this, action); }

  void on(const action::EditView& a);
  void on(const action::InspectNode& a);
  void on(const action::FitView&);
  void on(const action::FitSelection&);
  void on(const action::LookAt& a);
  void on(const action::ZoomTo& a);
  void on(const action::BoxZoom&);
  void on(const action::BackView&) { view_history_.back(camera_); }
  void on(const action::ForwardView&) { view_history_.forward(camera_); }
  void on(const action::GoTo& a);
  void on(const action::AskGoTo&);
  void on(const action::PinMagnifier&);
  void on(const action::StepScale& a);
  void on(const action::RestoreSession& a);
  void on(const action::DiscardSession& a) { autosave_.discard(a.folder); }
  void on(const action::ClearRecent&) { recent_.clear(); }
  void on(const action::ShowWelcome&);
  void on(const action::StartDemo& a);
  void on(const action::StepDemo& a) { demo_.go(a.by, session_, actions_); }
  void on(const action::PlayDemo& a) { demo_.play(a.automatic); }
  void on(const action::EndDemo&) { demo_.end(); }
  void look_at_start();

  WorkbenchOptions options_;
  SettingsFile settings_file_;
  std::unique_ptr<UiLayer> ui_;
  Session session_;
  Autosave autosave_;
  Capture capture_{session_};
  ViewOptions view_;
  ViewState view_state_;
  Camera camera_;
  ViewHistory view_history_;
  BeforeMesh before_;
  Layout layout_;
  Viewport viewport_;
  NodeTool node_tool_;
  MeshView mesh_view_;
  IdLabels id_labels_;
  LegendCard legend_card_;
  std::optional<Inset> lens_;
  Area tile_;           // part of the framebuffer that is being painted, pixels
  Vec2 pointer_{0, 0};  // pixels
  bool pointer_over_ = false;
  ActionQueue actions_;
  int width_ = 1, height_ = 1;
  std::uint64_t generation_ = 0;  // of the mesh that the camera was set up for
  double reach_ = 0;              // of the selection, when nothing was moving
  bool picturing_ = false;        // the frame being laid out is for a picture, not for the window
  bool mesh_alone_ = false;       // and shows nothing but the mesh
  std::unique_ptr<UiLayer> picture_ui_;  // of the last picture: the next often has its size
  double picture_age_ = 0;               // seconds since the last picture
  RecentFiles recent_;
  DemoPlayer demo_;
  std::filesystem::path shown_path_;  // of the mesh that stands in recent_
  std::size_t dropped_ = 0;           // files that the mesh being opened was dropped with

  WelcomePanel welcome_;
  PanelRegistry panels_;
  Dialogs dialogs_{session_};
};

}  // namespace winslow::gui
