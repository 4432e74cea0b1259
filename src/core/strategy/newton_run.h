#pragma once

#include "core/motion/motion.h"
#include "core/outer/outer_solver.h"
#include "core/outer/path_follower.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/twist.h"
#include "core/strategy/untangling.h"
#include "core/strategy/workspace.h"

namespace winslow {

/// Smooths by Newton's method on one formulation: untangles if needed, then applies Newton's
/// method; follows a path if the boundary moves. Subclasses provide the solvers.
class NewtonRun {
 public:
  virtual ~NewtonRun() = default;

  /// Sets quality limits; move() along a path ends before a mesh that violates them.
  void keep_within(QualityFloor floor) { floor_ = std::move(floor); }
  /// move() along a path does not begin a motion that contact blocks.
  void end_at_contact(bool whether) { end_at_contact_ = whether; }
  /// Tells move() that the motion has no contact, so it need not search for one.
  void way_is_clear() { way_is_clear_ = true; }
  /// Tells move() that something is inverted on the way, so it has to go the whole way.
  void way_is_blocked() { may_carry_ = false; }
  /// Smooths with the boundary held. reference: a valid mesh of the same connectivity that gives
  /// the sizes of the elements for untangling; may be null.
  virtual void smooth(Coordinates& x, double fraction, const Coordinates* reference);
  /// Carries out a motion of the mesh as given from run.start, which may be near its end.
  ///
  /// First predicts the result, and converges from there: from a combination of known meshes
  /// (NearStart::earlier) with nearly the boundary of the result, else from the known mesh with the
  /// nearest boundary, to first order in the way that the boundary has from there. If the
  /// prediction is not valid or too far from the result, follows the path from the start, or starts
  /// in one step where the start is not valid. x: receives the result. Returns false, and leaves x
  /// as it is, if the start is of no use.
  bool start_near(const Motion& motion, const RunOptions& run, Coordinates& x);
  /// Moves the boundary from x (any mesh, at the start of the motion) in `increments` equal steps,
  /// without intermediate meshes; 0: along a path of valid meshes, which ends at the last valid one
  /// if blocked. rest: the mesh to which the motion refers.
  virtual void move(const Motion& motion, const Coordinates& rest, int increments, Coordinates& x);

 protected:
  /// The workspace is prepared. The references outlive the run.
  NewtonRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : state_(state), workspace_(workspace), recorder_(recorder) {}

  virtual SteadySolver& newton() = 0;
  virtual const LinearSolver& linear() = 0;  ///< used by newton()
  /// Called after untangling by the energy: it used linear() for its own systems, and its mesh
  /// differs much from that for which newton() was prepared.
  virtual void begin_anew() {}
  /// Called before Newton's method, at a valid mesh that may be far from the solution; iterates
  /// until `enough` returns true.
  virtual void relax(Coordinates& /*x*/, double /*fraction*/,
                     const RunRecorder::Enough& /*enough*/) {}
  /// Whether first-order steps pay.
  virtual bool descends() { return false; }
  /// Called before relax() and Newton's method, at a valid mesh: at most `limit` first-order steps
  /// towards the solution, where these pay. Iterates until `enough` returns true. Returns whether
  /// the mesh is near the solution (near_enough()); if it is one, the recorder knows.
  virtual bool descend(Coordinates& /*x*/, double /*fraction*/, int /*limit*/,
                       const RunRecorder::Enough& /*enough*/) {
    return false;
  }
  /// Called at a solution. Returns true if Newton's method should continue to a better one that
  /// relax() gave up.
  virtual bool sharpen(const Coordinates& /*x*/) { return false; }
  /// Whether a mesh on the path has left the range for which relax() prepared Newton's method.
  virtual bool strained(const Coordinates& /*x*/) { return false; }
  /// Called before a path is followed, and when it is left: the path may lead along the solutions
  /// of an easier problem.
  virtual void begin_path() {}
  virtual void leave_path() {}
  /// Whether begin_path() made the problem easier and leave_path() was not called yet.
  virtual bool on_path() const { return false; }
  /// Whether vary_targets() has an effect.
  virtual bool has_targets() const { return false; }
  /// Uses the shapes of a valid mesh as the targets at share 0 of a path, so that the mesh is the
  /// solution there.
  virtual void vary_targets(const Coordinates& /*from*/) {}
  /// Sets the targets of Newton's method to this share of the way from those to the wanted ones.
  virtual void set_target_share(double /*share*/) {}
  /// Whether to continue from a mesh off the path if Newton's method does not lead back.
  virtual bool insists() const { return true; }

  /// Whether the scaled residual is small enough to follow the path from this mesh.
  static bool near_enough(const IterationRecord& record) { return record.residual < 0.05; }

  SmoothingWorkspace& workspace() { return workspace_; }
  RunRecorder& recorder() { return recorder_; }

 private:
  class Prediction;
  /// Takes a valid mesh near its solution to the boundary of `target`, to first order: one linear
  /// solve. Returns false if the mesh is not near its solution; x is then undefined.
  bool follow_boundary(const Coordinates& target, Coordinates& x);
  /// Converges from a mesh near the solution, whose boundary is at its end. Returns false if the
  /// mesh is not that near; x is then undefined.
  bool converge_near(Coordinates& x);
  void move_along_path(const Motion& motion, const Coordinates& rest, Coordinates& x);
  void move_in_steps(const Motion& motion, const Coordinates& rest, int increments, Coordinates& x);
  bool untangle(Coordinates& x, double fraction, const Coordinates* reference);
  bool approach(Coordinates& x, double fraction);
  void begin_with_own_shapes(const Coordinates& start, Coordinates& x);
  void relax_along_targets(Coordinates& x, double fraction);
  struct PathMesh {
    double fraction;
    Coordinates x;
  };
  Coordinates carried(const Twist& twist, const Path& path, const Coordinates& x, double from,
                      double to);
  std::optional<IterationRecord> correct(Coordinates& x);
  double carry_and_descend(const Motion& motion, const Path& path, double least_sine,
                           Coordinates& x);
  double carry_along(const Motion& motion, const Path& path, Coordinates& x);
  void follow_path(const Path& path, double reached, double least_sine, Coordinates& x);
  static void go_back(const Path& path, PathMesh& earlier, double& reached, Coordinates& x);
  bool blocked_by_contact() const { return recorder_.result().contact.has_value(); }
  bool settle(Coordinates& x, double fraction);
  bool converge(Coordinates& x, double fraction, bool at_any_pace = true);
  std::string fault(const Coordinates& x) const;
  double smallest_sine(const Coordinates& x) const;
  std::vector<Index> yielding_nodes() const;
  void end_path(Coordinates& x, double reached);

  const MeshState& state_;
  SmoothingWorkspace& workspace_;
  RunRecorder& recorder_;
  QualityFloor floor_;
  bool end_at_contact_ = false, way_is_clear_ = false, may_carry_ = true;
};

}  // namespace winslow
