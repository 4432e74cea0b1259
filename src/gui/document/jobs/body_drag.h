#pragma once

#include "core/drag/drag_session.h"
#include "core/quality/mesh_change.h"
#include "core/strategy/run.h"
#include "gui/document/jobs/reference_files.h"

namespace winslow::gui {

/// What the mouse drags, seen from the frame loop, in a plane mesh or a volume mesh: every position
/// is answered within the frame by a valid mesh, and solved for behind the frame loop's back.
/// Nothing here waits for the solver.
class BodyDrag {
 public:
  /// How far the mesh has followed.
  enum class Reach {
    there,        ///< the mesh on screen has the body where the mouse wants it
    catching_up,  ///< not yet: the solver is on its way
    limit         ///< as far as a valid mesh was found
  };

  /// files: what the options ask for. A reference surface is read while the mesh stays as it is.
  /// Throws what DragSession throws; nothing has begun then.
  void begin(const MeshState& state, DragGrip grip, const SmoothOptions& options,
             std::optional<DragSession::Start> start = {}, const ResolveFiles& files = no_files);
  void to(const RigidMotion& motion);
  /// Takes what the solver has found since the last call. True if the mesh on screen changed.
  bool poll();
  void end();

  bool active() const { return frame_ != nullptr; }
  // While active.
  const DragFrame& frame() const { return *frame_; }
  const Coordinates& coordinates() const { return frame_->coordinates; }
  const DragGrip& grip() const { return grip_; }
  const RigidMotion& wanted() const { return wanted_; }
  Reach reach() const;
  /// Why the mesh follows no further, wherever the mouse goes; empty as long as it does.
  std::string error() const { return session_ ? session_->error() : unread_; }
  /// The frame is the solution for the position asked for.
  bool settled() const { return session_ && session_->settled(); }

 private:
  std::unique_ptr<DragSession> session_;  // null: its files are being read, or cannot be
  std::future<std::unique_ptr<DragSession>> reading_;
  std::string unread_;                // why its files cannot be read; empty: they can
  DragFrame still_;                   // without a session
  const DragFrame* frame_ = nullptr;  // the session's, or still_
  DragGrip grip_;
  RigidMotion wanted_;
  int revision_ = 0;
  std::vector<std::future<void>> ending_;  // a session ends with its present iteration
};

/// What is said of a drag while it goes on.

/// What is in a body's way: "Blocked by "main"".
std::string blocked_text(const EdgePair& contact);
/// The same of a drag, where the mesh can follow no further.
std::string blocked_text(const BodyDrag& drag);
/// "Updating mesh... 35 %": how far the mesh on screen has come of what the mouse asks for.
std::string updating_text(const BodyDrag& drag);

/// Why a body did not get where it was to go, in whole sentences for the banner over the mesh.

/// "Blocked by "main" after 41.2 % of the drag: the body is where it got to." drag: at its limit.
std::string end_of_drag(const BodyDrag& drag);

/// How a motion is to be judged that is not all that was asked for.
struct MotionEnd {
  const SmoothResult& smooth;
  double reached;             ///< share of the motion, 0 to 1
  const QualityFloor& floor;  ///< the limits that it had
  const Mesh& mesh;           ///< where it ended
};
/// "Blocked by "main" after 41.2 % of the motion: the body is where it got to." Of limits of the
/// quality also what the mesh comes to by them.
std::string end_of_motion(const MotionEnd& end);

}  // namespace winslow::gui
