#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/drag/drag_session.h"

namespace winslow::gui {

/// What the mouse drags, seen from the frame loop: every position is answered within the frame by a
/// valid mesh, and solved for behind the frame loop's back. Nothing here waits for the solver.
class BodyDrag {
 public:
  /// How far the mesh has followed.
  enum class Reach {
    there,        ///< the mesh on screen has the body where the mouse wants it
    catching_up,  ///< not yet: the solver is on its way
    limit         ///< as far as a valid mesh was found
  };

  /// Throws what DragSession throws; nothing has begun then.
  void begin(const MeshState& state, DragGrip grip, const SmoothOptions& options,
             std::optional<DragSession::Start> start = {});
  void to(const RigidMotion& motion);
  /// Takes what the solver has found since the last call. True if the mesh on screen changed.
  bool poll();
  void end();

  bool active() const { return session_ != nullptr; }
  // While active.
  const DragFrame& frame() const { return *frame_; }
  const DragGrip& grip() const { return grip_; }
  const RigidMotion& wanted() const { return wanted_; }
  Reach reach() const;
  /// The frame is the solution for the position asked for.
  bool settled() const { return session_->settled(); }

 private:
  std::unique_ptr<DragSession> session_;
  const DragFrame* frame_ = nullptr;
  DragGrip grip_;
  RigidMotion wanted_;
  int revision_ = 0;
  std::vector<std::future<void>> ending_;  // a session ends with its present iteration
};

}  // namespace winslow::gui
