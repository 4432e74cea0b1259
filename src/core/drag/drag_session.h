#pragma once

#include "core/drag/drag_grip.h"
#include "core/mesh/mesh.h"

/// A body follows the mouse, and its last place becomes a command:
///
///     winslow::DragSession drag(state, grip, winslow::SmoothOptions());
///     const winslow::DragFrame& shown = drag.to(motion);  // at once; draw shown.coordinates
///     winslow::Command done = winslow::drag_command(grip, motion, {}, winslow::SmoothOptions());
namespace winslow {

/// What is shown under the mouse.
struct DragFrame {
  Coordinates coordinates;  ///< a valid mesh, always
  RigidMotion motion;       ///< where the body is in it, seen from the state
  bool held = false;        ///< the mesh cannot go where the mouse is (yet): the last valid one
  bool limit = false;       ///< held, and the path to where the mouse is ended on the way
  double share = 1;         ///< of the way from the state to where the mouse is
  double min_sine = 0;      ///< of the frame's elements
  /// What the body would touch on the way to where the mouse is; none: nothing that is known of.
  std::optional<EdgePair> contact = {};
};

/// A drag with the mouse, of a plane mesh or of a volume mesh: every position asked for is answered
/// at once, by the tangent fields of the last mesh that was solved for and an exact check of
/// validity. Meanwhile a thread follows the path to the last position and prepares the fields anew
/// there. Members are called from one thread and never wait, except the destructor, which cancels
/// and joins.
class DragSession {
 public:
  /// A mesh to go on from: valid, the grip moved by `motion` from where it is in the state.
  struct Start {
    Coordinates coordinates;
    RigidMotion motion;
  };
  /// state: a valid mesh, which the motions refer to. grip: what is held. start: where the drag
  /// goes on from, if not from the state itself. files: what the options ask for. Throws UsageError
  /// for unknown markers, out-of-range options, those that ask for what is not in `files`, a
  /// tangled mesh or a surface mesh.
  DragSession(MeshState state, DragGrip grip, const SmoothOptions& options,
              std::optional<Start> start = {}, const SlideFiles& files = {});
  /// What is shown at first, for who has yet to read the files. start: null for none. Throws what
  /// the constructor throws of all but files.
  static DragFrame first_frame(const MeshState& state, const DragGrip& grip,
                               const SmoothOptions& options, const Start* start);
  ~DragSession();
  DragSession(const DragSession&) = delete;
  DragSession& operator=(const DragSession&) = delete;

  /// The mesh with the body moved by `motion` from where it is in the state, or as near to it as
  /// was valid so far. A motion without a pivot turns about the middle of what is held. Throws
  /// UsageError for a motion that the mesh does not have.
  const DragFrame& to(const RigidMotion& motion);
  /// False until the first fields are prepared; to() holds the state until then.
  bool ready() const;
  /// True if the fields belong to the position last asked for: the next frame there is the solution
  /// itself, or the limit.
  bool settled() const;
  /// Number of meshes solved for so far.
  int corrections() const;
  /// Grows whenever to() may have a better answer to the same motion: after a correction, and
  /// with every valid mesh on the way to one that takes long.
  int revision() const;
  /// Why no more corrections come; empty as long as they do.
  std::string error() const;

 private:
  class Impl;
  LocalFrame frame_;  // in which the mesh is solved for
  int dimension_;
  Coordinates rest_;  // of the state
  DragFrame shown_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace winslow
