#pragma once

#include "gui/demos/demo.h"
#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"

namespace winslow::gui {

/// Plays a demo in the studio: opens its mesh and turns its steps into actions, one step on each
/// request. The user may edit the mesh meanwhile; such changes are kept. Opening another mesh or
/// closing this one ends the demo.
class DemoPlayer {
 public:
  /// Null if none is being played.
  const Demo* demo() const { return demo_; }
  std::size_t step() const { return step_; }
  /// The mesh is open and the step's command is done.
  bool ready(const Session& session) const;
  bool automatic() const { return automatic_; }

  /// Starts a demo; its mesh is in `folder`.
  void start(const Demo& demo, const std::filesystem::path& folder, const Session& session,
             ActionQueue& actions);
  /// Goes to the next step, or back to the end of the previous one. Has no effect until ready().
  void go(int by, const Session& session, ActionQueue& actions);
  void play(bool automatic) { automatic_ = automatic; }
  void end() { demo_ = nullptr; }

  /// Call it once per frame. seconds: since the last.
  void update(const Session& session, double seconds, ActionQueue& actions);

 private:
  void begin_step(const Session& session, ActionQueue& actions);

  const Demo* demo_ = nullptr;
  std::size_t step_ = 0;
  bool automatic_ = false, opened_ = false, begun_ = false;
  bool opening_seen_ = false;        // the session has begun to open the mesh
  double rested_ = 0;                // seconds since the step was ready
  std::uint64_t generation_ = 0;     // of the demo's mesh, or of the previous mesh
  std::vector<std::size_t> before_;  // position of the history when each step began
};

}  // namespace winslow::gui
