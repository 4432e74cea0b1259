#pragma once

#include "core/drag/drag_grip.h"
#include "core/mesh/mesh.h"

/// Moves a body with the mouse; the last position becomes a command:
///
///     winslow::DragSession drag(state, grip, winslow::SmoothOptions());
///     const winslow::DragFrame& shown = drag.to(motion);  // at once; draw shown.coordinates
///     winslow::Command done = winslow::drag_command(grip, motion, {}, winslow::SmoothOptions());
namespace winslow {

/// What is shown under the mouse.
struct DragFrame {
  Coordinates coordinates;  ///< a valid mesh, always
  RigidMotion motion;       ///< of the body in this mesh, relative to the state
  bool held = false;        ///< no valid mesh at the mouse (yet): shows the last one
  bool limit = false;       ///< held, because the path to the mouse position is blocked
  double share = 1;         ///< share of the motion from the state to the mouse position
  double min_sine = 0;      ///< of the frame's elements
  /// What the body would touch on the way to the mouse position; none: no known contact.
  std::optional<EdgePair> contact = {};
};

/// Drags a body or a part of one in a plane or volume mesh. Every requested position is answered at
/// once: the tangent fields of the last solved mesh predict the new mesh, and an exact check tests
/// its validity. Meanwhile a thread follows the path to the last position and recomputes the fields
/// there. Members are called from one thread and never wait, except the destructor, which cancels
/// and joins.
class DragSession {
 public:
  /// A valid mesh to continue from. The grip is moved by `motion` from its position in the state.
  struct Start {
    Coordinates coordinates;
    RigidMotion motion;
  };
  /// state: a valid mesh, to which the motions refer. grip: what is held. start: where the drag
  /// continues, if not at the state itself. files: contents of the files that the options name.
  /// Throws UsageError for unknown markers, options that are out of range or name a file that
  /// `files` lacks, a tangled mesh, or a surface mesh.
  DragSession(MeshState state, DragGrip grip, const SmoothOptions& options,
              std::optional<Start> start = {}, const SlideFiles& files = {});
  /// The first frame, for a client that has not read the files yet. start: null for none. Throws as
  /// the constructor does, except for files.
  static DragFrame first_frame(const MeshState& state, const DragGrip& grip,
                               const SmoothOptions& options, const Start* start);
  ~DragSession();
  DragSession(const DragSession&) = delete;
  DragSession& operator=(const DragSession&) = delete;

  /// Returns the mesh with the body moved by `motion` from its position in the state, or the
  /// nearest valid mesh found so far. The body keeps on what it stands on: see along(). A motion
  /// without a pivot rotates about the centre of what is
  /// held. Throws UsageError for a motion that a mesh of this dimension does not have.
  const DragFrame& to(const RigidMotion& motion);
  /// The motion that to() carries out: the nearest one that keeps the body on the straight line,
  /// circle, plane, cylinder or sphere on which it stands (along_footholds()). Throws as to() does.
  RigidMotion along(const RigidMotion& motion) const;
  /// False until the first fields are prepared; to() holds the state until then.
  bool ready() const;
  /// True if the fields belong to the position last asked for: the next frame there is the solution
  /// itself, or the limit.
  bool settled() const;
  /// Number of meshes solved for so far.
  int corrections() const;
  /// Increases whenever to() may have a better answer to the same motion: after each correction,
  /// and after every valid intermediate mesh of a long correction.
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
