#pragma once

#include "gui/base/background.h"
#include "gui/base/screen.h"
#include "gui/document/actions/actions.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/session.h"
#include "gui/picture/capture/recorder.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/render/image.h"
#include "gui/settings/picture_spec.h"

namespace winslow::gui {

/// The meshes of a film: those on screen and, where a job moves a body in large steps, those of
/// meshes_between() in between.
class FilmMeshes {
 public:
  /// Forgets the last mesh, as if nothing had been shown yet.
  void clear();
  /// True if the mesh on screen is the one last collected.
  bool has(const Coordinates& x) const { return taken_.size() == x.size() && taken_ == x; }
  /// Collects the mesh on screen, as the last one, after those between it and the one last
  /// collected. between: false: only the mesh on screen. All are of the session's topology.
  std::vector<Coordinates> collect(const Session& session, bool between = true);

 private:
  void follow_motion(const Session& session);

  Coordinates taken_;
  std::vector<std::vector<Index>> moved_;  // nodes of each body moved by the job under way
};

/// Draws pictures of the window and of the mesh, for Capture.
class PictureSource {
 public:
  virtual ~PictureSource() = default;
  /// A picture of the window as it is.
  virtual Image picture() = 0;
  /// A picture as specified. Throws UsageError for a size out of range, Error if OpenGL fails.
  virtual Image picture(const PictureSpec& spec) = 0;
  /// The same with the nodes of the mesh on screen at other places (#nodes by 2).
  virtual Image picture_of(const Coordinates& nodes, const PictureSpec& spec) = 0;
  /// Width and height on screen, pixels, of what a picture shows.
  virtual ScreenVector picture_extent(const PictureSpec& spec) const = 0;
  /// The mesh alone, for vector graphics.
  virtual VectorFigure figure(bool legend) const = 0;
};

/// Takes pictures and recordings of the studio: holds their settings and those that are due, and
/// writes them.
class Capture {
 public:
  explicit Capture(Session& session) : session_(session) {}

  const PictureSpec& picture() const { return picture_; }
  const RecordingSpec& recording() const { return recording_; }
  const Recorder& recorder() const { return recorder_; }

  void apply(const PictureAction& action) { Dispatch::to(*this, action); }
  /// Takes the pictures that are due of the frame just laid out. Call it once a frame.
  void after_frame(PictureSource& source);
  /// Collects finished work of the threads. True if there is news to show.
  bool poll();
  /// True if something is under way that ends by itself.
  bool busy() const;

  /// A name that no picture in the working folder has yet.
  static std::filesystem::path new_picture_name();

  void on(const action::TakeScreenshot& a);
  void on(const action::SetPictureSpec& a) { picture_ = a.spec; }
  void on(const action::SavePicture& a);
  void on(const action::SetRecordingSpec& a) { recording_ = a.spec; }
  void on(const action::StartRecording& a);
  void on(const action::StopRecording&);
  void on(const action::CancelRecording&);

 private:
  struct Due {
    std::filesystem::path path;
    bool as_set = false;  // as picture_ says; else the window as it is
    int delay = 0;        // frames until menus and dialogs are gone from the picture
  };
  void save_picture(PictureSource& source, const std::filesystem::path& path, bool as_set);
  void record_frame(PictureSource& source);
  void queue_frames();
  void queue_turn();
  bool turning() const;
  bool record_queued(PictureSource& source);
  bool frame_due() const;
  void step_on();
  void follow_solver();

  Session& session_;
  PictureSpec picture_;
  RecordingSpec recording_;
  std::optional<Due> due_;
  PictureWriter writer_;
  Background<std::string> figure_;  // the figure being written; returns its error
  std::filesystem::path figure_path_;
  Recorder recorder_;
  /// A mesh that is to be recorded.
  struct Frame {
    std::shared_ptr<const Topology> topology;
    Coordinates coordinates;
    double turned = 0;  ///< of the view, see PictureSpec
  };
  std::deque<Frame> queue_;  // in the order of the film
  FilmMeshes meshes_;
  bool ending_ = false;     // the recording ends with the queue
  bool following_ = false;  // the solver waits for pictures
  bool stepping_ = false;   // the job continues once its frame is recorded
  int turns_ = 0;           // frames of a turn that have been queued
  std::uint64_t shape_ = 0;
  std::uint64_t left_ = 0;  // serial of the pause from which the last step continued
  std::chrono::steady_clock::time_point last_frame_{};
};

}  // namespace winslow::gui
