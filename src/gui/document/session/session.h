#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gui/base/background.h"
#include "gui/document/actions/actions.h"
#include "gui/document/actions/dispatch.h"
#include "gui/document/actions/messages.h"
#include "gui/document/history/command_queue.h"
#include "gui/document/history/document.h"
#include "gui/document/history/restored_session.h"
#include "gui/document/jobs/body_drag.h"
#include "gui/document/jobs/job_runner.h"
#include "gui/document/jobs/layer_preview.h"
#include "gui/document/jobs/method.h"
#include "gui/document/jobs/quality_monitor.h"
#include "gui/document/selection/boundary_index.h"
#include "gui/document/selection/node_selection.h"

namespace winslow::gui {

/// The state of the studio, without a window: the open mesh, its history, the solver, what is
/// selected, what is to be said. Changes by actions and by poll() alone. Nothing here waits.
class Session {
 public:
  Session();

  void apply(const DocumentAction& action);
  /// Collects what the threads have done since the last call. True if anything changed.
  bool poll();
  /// True while some thread works on behalf of this session.
  bool working() const;

  const Document* document() const { return document_.get(); }
  bool loading() const { return loader_.busy(); }
  const std::filesystem::path& loading_path() const { return loading_path_; }
  bool saving() const { return saver_.busy(); }
  bool quit_accepted() const { return quit_; }
  /// Grows when another mesh is opened.
  std::uint64_t generation() const { return generation_; }

  /// The mesh on screen: that of the history, or of the job under way.
  const Coordinates& coordinates() const;
  /// That coordinates() are of: a job may change it on its way. Null without a mesh.
  const std::shared_ptr<const Topology>& topology() const;
  /// Layers of the mesh on screen; null where there are none, or not all of them yet.
  std::shared_ptr<const LayerStack> layers() const;
  /// Grows whenever coordinates() may have changed.
  std::uint64_t shape() const { return shape_; }

  const JobRunner& job() const { return job_; }
  bool dragging() const { return dragging_; }
  /// The mesh on screen is not (yet) one of the history.
  bool in_motion() const { return job_.active() || drag_.active(); }
  /// The drag under the mouse that shows valid meshes only; null without one, and in the paper's
  /// direct mode, where the job shows what the solver has.
  const BodyDrag* body_drag() const { return drag_.active() ? &drag_ : nullptr; }
  /// State that live_motion() is seen from.
  const MeshState& motion_base() const;
  /// Motion of the job under way, from the state it started from.
  std::optional<RigidMotion> live_motion() const;
  /// Of the job under way, or else of the command that led to the present mesh.
  std::span<const IterationRecord> convergence() const;

  const BoundaryIndex* boundary() const { return boundary_.get(); }
  const std::vector<Index>& selection() const { return selection_; }
  bool selected(Index marker) const;
  const std::vector<Index>& hovered() const { return hovered_; }
  /// Point about which the selection turns, where it is on screen now.
  Vec2 pivot() const;
  /// Points of the selection where it stands between motions; none without a selection.
  const std::optional<BodyAnchors>& anchors() const { return anchors_; }
  /// Where the pivot was put; none: to a place of its own.
  std::optional<PivotPlace> pivot_place() const { return pivot_place_; }

  const ShapeEdit& shape_edit() const { return shape_edit_; }
  /// A deformation of the selection that is not yet carried out.
  struct DeformationPreview {
    SineDeformation shape;
    std::vector<std::pair<Vec2, Vec2>> outline;  ///< edges where it would put them
  };
  const std::optional<DeformationPreview>& deformation_preview() const { return preview_; }

  /// Layers that are planned for the mesh of the history.
  const LayerPreview& layer_preview() const { return layer_preview_; }

  const NodeSelection& nodes() const { return nodes_; }
  /// Virtual control volumes of the mesh on screen; null without a mesh.
  std::shared_ptr<const VirtualControlVolumes> vcv() const;

  const SmoothOptions& smooth_options() const { return smooth_; }
  const MotionOptions& motion_options() const { return motion_; }
  /// Iterations a second of the direct method; 0: as fast as they come.
  double pace() const { return pace_; }
  /// Commands that wait for the one under way.
  const CommandQueue& queue() const { return queue_; }

  /// Measures the mesh on screen in the background, by this field among others.
  void watch_quality(std::optional<ElementField> field);
  /// Measures it before returning: for a picture whose colours must be those of its mesh.
  void measure_quality_now(std::optional<ElementField> field);
  const QualityMonitor& quality() const { return quality_; }

  const Prompt* prompt() const { return prompts_.empty() ? nullptr : &prompts_.front(); }
  const std::optional<Banner>& banner() const { return banner_; }
  /// The user has put the banner of the present mesh away.
  bool banner_dismissed() const {
    return document_ && dismissed_ == std::pair(generation_, document_->revision());
  }
  const std::optional<Notice>& notice() const { return notice_; }
  void tell(Notice::Kind kind, std::string text);
  void report_error(std::string title, std::string text);
  /// Puts a session that outlived a crash in place of what is open.
  void restore(RestoredSession restored);
  void ask(Prompt prompt) { prompts_.push_back(std::move(prompt)); }

 private:
  friend class Dispatch;

  // Files (session_files.cpp, session_export.cpp)
  void on(const action::OpenMesh& a);
  void on(const action::SaveMesh& a);
  void on(const action::ExportRecipe& a);
  void on(const action::CloseMesh& a);
  void on(const action::ExportMesh& a);
  void on(const action::ExportMarkers& a);
  void on(const action::Quit& a);
  bool poll_loader();
  bool poll_saver();
  void forget_mesh();
  void adopt(Document::Loaded loaded);

  // Bodies, jobs, history (session.cpp, session_jobs.cpp)
  void on(const action::SelectMarkers& a);
  void on(const action::HoverMarkers& a);
  void on(const action::CycleBody& a);
  void on(const action::SetPivot& a);
  void on(const action::SetShapeEdit& a);
  void on(const action::SelectArc& a);
  void on(const action::PreviewDeformation& a);
  void on(const action::ApplyDeformation& a);
  void on(const action::PreviewLayers& a) { layer_preview_.want(a.options); }
  void on(const action::ApplyMotion& a);
  void on(const action::BeginDrag& a);
  void on(const action::DragTo& a);
  void on(const action::EndDrag&);
  void on(const action::CancelDrag&);
  void on(const action::EditMotionOptions& a);
  // Nodes and their VCVs (session_vcv.cpp)
  void on(const action::SelectNode& a);
  void on(const action::HoverNode& a);
  void on(const action::PinNodes& a);
  void on(const action::EditVcvs& a);
  void on(const action::EndVcvEdit&);
  void on(const action::CancelVcvEdit&);
  bool exists(Index node) const;

  void on(const action::RunSmooth&);
  void on(const action::Scramble& a);
  void on(const action::PauseSolver&);
  void on(const action::ResumeSolver&);
  void on(const action::StepSolver& a);
  void on(const action::CancelSolver&);
  void on(const action::EditSmoothOptions& a);
  void on(const action::SetPace& a);
  void on(const action::RunCommand& a);
  void on(const action::RerunStep& a);
  void on(const action::Undo&);
  void on(const action::Redo&);
  void on(const action::GoToStep& a);

  // Past commands, recipes and exports (session_history.cpp)
  void on(const action::EditStep& a);
  void on(const action::DeleteStep& a);
  void on(const action::BringBack& a);
  void on(const action::ReplayRecipe& a);
  void on(const action::ExportConvergence& a);
  bool poll_recipe();
  bool poll_csv();
  bool may_change_history();
  void revise(std::size_t step, std::string why, CommandQueue::Plan plan);
  void run_queue(bool paused);
  void stop_queue_at(const std::string& error);
  void abandon_queue();
  std::string cancelled_text() const;

  void on(const action::DismissPrompt&);
  void on(const action::DismissBanner&);

  bool start_job(Command command, bool paused, std::optional<Coordinates> start = {});
  bool begin_body_drag(DragGrip grip);
  void end_body_drag();
  void settle_motion(JobRunner::Outcome& outcome);
  bool can_join(const std::vector<std::string>& markers) const;
  MoveCommand move_command(const RigidMotion& motion) const;
  void finish_job(JobRunner::Outcome outcome);
  void end_rerun();
  void stop_job();
  double pace_of(Command command) const;
  void shape_changed();
  void follow_topology();
  void follow_nodes(const std::shared_ptr<const Topology>& before,
                    const std::shared_ptr<const Topology>& now);
  MeshState measured_state() const;
  void position_changed();
  void banner_of_position();
  void place_pivot();
  void update_anchors();
  void update_banner(const SmoothResult& smooth);
  void tell_finished(const std::string& what, const SmoothResult& smooth);
  std::vector<std::string> selected_names() const;

  struct LoadOutcome {
    std::shared_ptr<Document::Loaded> loaded;
    std::string error;
  };
  struct SaveOutcome {
    std::filesystem::path path;
    std::uint64_t generation = 0, revision = 0;
    std::vector<std::string> warnings;
    std::string error;
    bool copy = false;  // the document is where it was
  };
  struct RecipeOutcome {
    std::filesystem::path path;
    std::uint64_t generation = 0;
    std::vector<Command> commands;
    std::string error;
  };
  struct CsvOutcome {
    std::filesystem::path path;
    std::size_t rows = 0;
    std::string error;
  };

  std::unique_ptr<Document> document_;
  std::unique_ptr<BoundaryIndex> boundary_;
  std::uint64_t generation_ = 0, shape_ = 0;
  bool quit_ = false;

  std::vector<Index> selection_, hovered_;
  Vec2 pivot_{0, 0};  // seen from the state before the job under way
  std::optional<PivotPlace> pivot_place_ = PivotPlace::centre;
  std::optional<BodyAnchors> anchors_;
  ShapeEdit shape_edit_;
  std::optional<DeformationPreview> preview_;
  LayerPreview layer_preview_;

  SmoothOptions smooth_;
  MotionOptions motion_;
  double pace_ = default_pace;
  bool dragging_ = false;
  std::optional<RigidMotion> drag_base_;  // motion of the job that the drag joined
  BodyDrag drag_;
  MeshState drag_state_;                   // that the drag's motions are seen from
  std::optional<Coordinates> drag_start_;  // mesh that the drag took over from a job
  std::optional<std::size_t> rerun_;       // position of the history that the job leads to again

  NodeSelection nodes_;
  /// Nodes that were let go of when the mesh on screen came to be of another connectivity.
  struct LostNodes {
    std::weak_ptr<const Topology> topology;  ///< of which they are
    std::vector<Index> pinned;
    std::optional<Index> inspected;
  };
  std::vector<LostNodes> lost_nodes_;
  std::shared_ptr<const VirtualControlVolumes> edited_vcv_;  // of the edit under way
  bool editing_vcv_ = false;                                 // under the mouse
  // While a job shows a mesh of another connectivity than the document's.
  std::shared_ptr<const VirtualControlVolumes> passing_vcv_;

  std::deque<Prompt> prompts_;
  std::optional<Banner> banner_;
  std::optional<std::pair<std::uint64_t, std::uint64_t>> dismissed_;  // generation and revision
  std::optional<Notice> notice_;

  std::filesystem::path loading_path_;
  std::filesystem::path next_path_;  // asked for while another mesh was being read
  QualityMonitor quality_;
  JobRunner job_;
  CommandQueue queue_;
  Background<LoadOutcome> loader_;
  Background<SaveOutcome> saver_;
  Background<RecipeOutcome> recipe_reader_;
  Background<CsvOutcome> csv_writer_;
};

}  // namespace winslow::gui
