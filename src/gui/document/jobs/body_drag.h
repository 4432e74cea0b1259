#pragma once

#include "core/drag/drag_session.h"
#include "core/quality/mesh_change.h"
#include "core/strategy/run.h"
#include "gui/document/jobs/reference_files.h"

namespace winslow::gui {

/// A drag in a plane or volume mesh, for the frame loop. Each position yields a valid mesh within
/// the frame and is solved for in the background. No function waits for the solver.
class BodyDrag {
 public:
  /// How far the mesh has followed.
  enum class Reach {
    there,        ///< in the mesh on screen the body is at the mouse position
    catching_up,  ///< the solver is still approaching that position
    limit         ///< at the last position with a valid mesh
  };

  /// files: resolves the files named by the options. While a reference surface is read, the mesh
  /// does not move. Throws the exceptions of DragSession; then no drag has begun.
  void begin(const MeshState& state, DragGrip grip, const SmoothOptions& options,
             std::optional<DragSession::Start> start = {}, const ResolveFiles& files = no_files);
  void to(const RigidMotion& motion);
  /// Collects the solver's results since the last call. True if the mesh on screen changed.
  bool poll();
  void end();

  bool active() const { return frame_ != nullptr; }
  // While active.
  const DragFrame& frame() const { return *frame_; }
  const Coordinates& coordinates() const { return frame_->coordinates; }
  const DragGrip& grip() const { return grip_; }
  const RigidMotion& wanted() const { return wanted_; }
  Reach reach() const;
  /// Why the mesh can no longer follow to any mouse position; empty while it can.
  std::string error() const { return session_ ? session_->error() : unread_; }
  /// True if the frame is the solution for the requested position.
  bool settled() const { return session_ && session_->settled(); }

 private:
  std::unique_ptr<DragSession> session_;  // null: its files are being read or are unreadable
  std::future<std::unique_ptr<DragSession>> reading_;
  std::string unread_;                // why its files cannot be read; empty: no error
  DragFrame still_;                   // shown without a session
  const DragFrame* frame_ = nullptr;  // the session's, or still_
  DragGrip grip_;
  RigidMotion wanted_;
  int revision_ = 0;
  std::vector<std::future<void>> ending_;  // sessions that finish their present iteration
};

/// Texts on a drag in progress.

/// The obstacle of a body: "Blocked by "main"".
std::string blocked_text(const EdgePair& contact);
/// The obstacle of a drag whose mesh can follow no further.
std::string blocked_text(const BodyDrag& drag);
/// "Updating mesh... 35 %": the share of the requested motion that the mesh on screen has reached.
std::string updating_text(const BodyDrag& drag);

/// Why a body did not reach its target, in sentences for the banner above the mesh.

/// "Blocked by "main" after 41.2 % of the drag: the body is where it got to." drag: has reached its
/// limit.
std::string end_of_drag(const BodyDrag& drag);

/// The result of a motion that ended early.
struct MotionEnd {
  const SmoothResult& smooth;
  double reached;             ///< share of the motion, 0 to 1
  const QualityFloor& floor;  ///< quality limits of the motion
  const Mesh& mesh;           ///< mesh at its end
};
/// "Blocked by "main" after 41.2 % of the motion: the body is where it got to." For quality limits,
/// also the values that the mesh reaches.
std::string end_of_motion(const MotionEnd& end);

}  // namespace winslow::gui
