#pragma once

#include "core/formulation/target_path.h"
#include "core/motion/motion.h"
#include "core/outer/outer_solver.h"
#include "core/outer/path_follower.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/untangling.h"
#include "core/strategy/workspace.h"

namespace winslow {

/// Smooths by Newton's method on one formulation: untangles where needed, then Newton; follows the
/// path where the boundary moves. The formulations differ in their solver only.
class NewtonRun {
 public:
  virtual ~NewtonRun() = default;

  /// Limits before which move() along a path ends.
  void keep_within(QualityFloor floor) { floor_ = std::move(floor); }
  /// move() along a path does not begin a motion that contact blocks.
  void end_at_contact(bool whether) { end_at_contact_ = whether; }
  /// There is no contact on the way: move() need not look for one.
  void way_is_clear() { way_is_clear_ = true; }
  /// The boundary stays. reference: a valid mesh of the same connectivity that says how large the
  /// triangles are to be while they are untangled; may be null.
  virtual void smooth(Coordinates& x, double fraction, const Coordinates* reference);
  /// Moves the boundary from x (any mesh; where the motion begins) in so many equal steps, each at
  /// once; 0: along a path of valid meshes. Stops at the last one if it leads no further. rest:
  /// what the motion refers to.
  virtual void move(const Motion& motion, const Coordinates& rest, int increments, Coordinates& x);

 protected:
  /// The workspace is prepared. The references outlive the run.
  NewtonRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : state_(state), workspace_(workspace), recorder_(recorder) {}

  virtual SteadySolver& newton() = 0;
  virtual const LinearSolver& linear() = 0;  ///< that newton() uses
  /// After untangling by the energy, which used linear() for its own systems, and whose mesh has
  /// little to do with what newton() was made fit for.
  virtual void begin_anew() {}
  /// Before Newton's method, from a valid mesh that may be far from the solution, until `enough`
  /// says so.
  virtual void relax(Coordinates& /*x*/, double /*fraction*/,
                     const RunRecorder::Enough& /*enough*/) {}
  /// At a solution: whether Newton's method should go on to a better one that relax() set aside.
  virtual bool sharpen(const Coordinates& /*x*/) { return false; }
  /// Whether a mesh on the path has left the range that relax() made Newton's method fit for.
  virtual bool strained(const Coordinates& /*x*/) { return false; }
  /// Whether vary_targets() is of use.
  virtual bool has_targets() const { return false; }
  /// Takes the shapes of a valid mesh for the targets at share 0 of a path, so that the mesh is the
  /// solution there.
  virtual void vary_targets(const Coordinates& /*from*/) {}
  /// Newton's method is on the targets at this share of the way from there to those wanted.
  virtual void set_target_share(double /*share*/) {}
  /// Whether to go on from a lost path to which Newton's method does not lead back.
  virtual bool insists() const { return true; }

  /// Scaled residual at which a mesh is near enough to its solution to follow the path from there.
  static bool near_enough(const IterationRecord& record) { return record.residual < 0.05; }

  SmoothingWorkspace& workspace() { return workspace_; }
  RunRecorder& recorder() { return recorder_; }

 private:
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
  void follow_path(const Path& path, double least_sine, Coordinates& x);
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
  bool end_at_contact_ = false, way_is_clear_ = false;
};

/// Smooths by the variational form.
class VariationalRun final : public NewtonRun {
 public:
  /// The workspace is prepared. The references outlive the run.
  VariationalRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : NewtonRun(state, workspace, recorder) {}

 private:
  SteadySolver& newton() override { return workspace().newton(); }
  const LinearSolver& linear() override { return workspace().symmetric_linear(); }
  void begin_anew() override;
  /// Far from a solution the steep penalty makes Newton's method creep: a gentle one first. Where
  /// even the mesh that this leads to has elements far beyond the knee, the knee is doubled until
  /// it has none.
  void relax(Coordinates& x, double fraction, const RunRecorder::Enough& enough) override;
  bool has_targets() const override { return true; }
  void vary_targets(const Coordinates& from) override;
  void set_target_share(double share) override;
  /// The mesh that the knee was doubled for was not a solution yet: a solution may do with less.
  bool sharpen(const Coordinates& x) override;
  bool strained(const Coordinates& x) override;

  const PenaltyOptions& asked_for() { return workspace().options().penalty; }
  double knee();
  /// The penalty asked for, with a knee that no element is far beyond.
  PenaltyOptions fitting(const Coordinates& x);
  /// Newton's method is on the energy with this penalty from here on.
  void change_penalty(const PenaltyOptions& penalty);

  const VariationalForm& energy();

  std::shared_ptr<const VariationalForm> energy_;  // that newton() is on; null: not made yet
  std::unique_ptr<const TargetPath> target_path_;
};

/// Moves the boundary of x and smooths by the paper's outer iteration. increments: steps in which
/// the boundary moves; 0: at once and, where that ends tangled, in more and more steps; where no
/// way leads to a valid mesh, the result is that of the direct way, converged or not. rest: what
/// the motion refers to.
void move_by_fixed_point(const Coordinates& rest, const Motion& motion, int increments,
                         int max_iterations, OuterSolver& solver, RunRecorder& recorder,
                         Coordinates& x);

/// Smooths by the paper's operator and Newton's method.
///
/// OuterMethod::automatic: if Newton's method does not converge, or does not complete the motion,
/// the paper's damped fixed point does all of it again from the start. (The operator's own solution
/// may be tangled, above all on quadrilaterals.) The result is the mesh of the fixed point; but if
/// that is tangled and Newton's is not, it is Newton's.
class PointwiseRun final : public NewtonRun {
 public:
  /// The workspace is prepared. The references outlive the run.
  PointwiseRun(const MeshState& state, SmoothingWorkspace& workspace, RunRecorder& recorder)
      : NewtonRun(state, workspace, recorder) {}

  void smooth(Coordinates& x, double fraction, const Coordinates* reference) override;
  void move(const Motion& motion, const Coordinates& rest, int increments, Coordinates& x) override;

 private:
  using Way = std::function<void(Coordinates& x)>;

  SteadySolver& newton() override { return workspace().pointwise_newton(); }
  const LinearSolver& linear() override { return workspace().newton_linear(); }
  /// Without a solution to go to, steps against the limit of validity only spoil the mesh.
  bool insists() const override { return false; }
  void attempt(const Way& by_newton, const Way& by_fixed_point, Coordinates& x);
};

}  // namespace winslow
