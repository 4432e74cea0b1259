#pragma once

#include "gui/demos/demo.h"
#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"

namespace winslow::gui {

/// Plays a demo in the studio: opens its mesh and turns its steps into actions, one when it is
/// asked for. The mesh is the user's all the while: what is done by hand in between is kept, and
/// opening another mesh or closing this one ends the demo.
class DemoPlayer {
 public:
  /// Null if none is being played.
  const Demo* demo() const { return demo_; }
  std::size_t step() const { return step_; }
  /// The mesh is open and the step's command is done.
  bool ready(const Session& session) const;
  bool automatic() const { return automatic_; }

  /// Begins with a demo; its mesh lies in `folder`.
  void start(const Demo& demo, const std::filesystem::path& folder, const Session& session,
             ActionQueue& actions);
  /// Goes a step on, or back to where the step before had ended. Waits until it is ready.
  void go(int by, const Session& session, ActionQueue& actions);
  void play(bool automatic) { automatic_ = automatic; }
  void end() { demo_ = nullptr; }

  /// Once a frame. seconds: since the last.
  void update(const Session& session, double seconds, ActionQueue& actions);

 private:
  void begin_step(const Session& session, ActionQueue& actions);

  const Demo* demo_ = nullptr;
  std::size_t step_ = 0;
  bool automatic_ = false, opened_ = false, begun_ = false;
  bool opening_seen_ = false;        // the session has taken up the opening of the mesh
  double rested_ = 0;                // seconds since the step was ready
  std::uint64_t generation_ = 0;     // of the demo's mesh, or of the one before it
  std::vector<std::size_t> before_;  // position of the history when each step began
};

}  // namespace winslow::gui
