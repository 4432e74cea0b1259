#pragma once

#include "core/linear/preconditioner.h"
#include "core/outer/outer_solver.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// The inverse Hessian of L-BFGS (D. C. Liu and J. Nocedal, Math. Program. 45, 1989) over a
/// preconditioner M, by inner products alone:
///
///   H = V_k ... V_1 (gamma M^-1) V_1^T ... V_k^T + ...,   V_i = I - y_i s_i^T / s_i . y_i,
///
/// s_i a step, y_i the change of the gradient along it. It keeps s_i and z_i = M^-1 y_i: all that
/// it needs of y_i are inner products, which are differences of those with two gradients. So an
/// iteration applies M^-1 once, and reads each kept vector twice.
///
/// Vectors are long and kept in single precision: their round-off only perturbs H.
class CurvatureMemory {
 public:
  /// depth: number of steps kept. threads: 0 for all cores; no result depends on it.
  CurvatureMemory(std::size_t depth, int threads) : depth_(depth), threads_(threads) {}

  /// Forgets all steps, as when M has changed.
  void clear() { pairs_.clear(); }
  /// Forgets all steps and frees their memory.
  void release() {
    pairs_.clear();
    spare_ = {};
  }
  /// Takes up a step s from where the gradient was g_before, and M^-1 of it mg_before, to where
  /// they are g and mg. A step along which the energy has no positive curvature is not kept.
  void add(std::span<const double> s, std::span<const double> g_before,
           std::span<const double> mg_before, std::span<const double> g,
           std::span<const double> mg);
  /// out = -H g. mg: M^-1 g.
  void direction(std::span<const double> mg, std::span<double> out) const;
  /// s . y / y . z of the last step kept: how much M has to be scaled by; 1 before.
  double scale() const {
    return pairs_.empty() ? 1 : pairs_.back().sy.front() / pairs_.back().zy.front();
  }
  std::size_t size() const { return pairs_.size(); }
  std::size_t bytes() const {
    std::size_t sum = bytes_of(spare_.s, spare_.z);
    for (const Pair& pair : pairs_) sum += bytes_of(pair.s, pair.z);
    return sum;
  }

 private:
  struct Pair {
    std::vector<float> s, z;
    double sg = 0, zg = 0;       // inner products with the present gradient
    std::vector<double> sy, zy;  // s . y and z . y of this and the later pairs, in order
  };
  std::vector<double> products(std::span<const double> g_before, std::span<const double> g,
                               const Pair& last) const;

  std::size_t depth_;
  int threads_;
  std::vector<Pair> pairs_;  // oldest first
  Pair spare_;               // memory of one that was given up
};

/// Options of EnergyDescent.
struct DescentOptions {
  double tolerance = 1e-10;  ///< of the largest scaled residual (ResidualNorms::max)
  int threads = 0;           ///< 0: all cores; no result depends on it
};

/// A first-order method on an energy in space, from a valid mesh through valid meshes only: L-BFGS,
/// preconditioned by one multigrid cycle on a scalar operator for all three components at once
/// (FirstOrderForm::laplacian()), which is made again where it no longer fits. An iteration costs a
/// fraction of a step of Newton's method, so where the operator resembles the Hessian this is the
/// faster way to, or near to, a solution.
///
/// The line search begins with the whole step, or below the exact largest valid step where the
/// whole one is not valid, and requires sufficient decrease of the energy, or a flatter slope where
/// round-off hides the decrease.
class EnergyDescent final : public OuterSolver {
 public:
  /// Throws UsageError if the problem has no first-order form.
  EnergyDescent(std::shared_ptr<const EnergyProblem> problem, const DescentOptions& options);

  /// Switches to another problem with the same number of unknowns. Call start() next.
  void set_problem(std::shared_ptr<const EnergyProblem> problem);
  /// Frees most of its memory until set_problem(), as while another method goes on.
  void rest();

  /// Throws UsageError for a mesh with inverted elements.
  IterationRecord start(const Coordinates& x) override;
  IterationRecord step(Coordinates& x) override;
  bool converged() const override;
  /// True if no step lowers the energy, or if the iteration is so slow that Newton's method is
  /// faster from here.
  bool stalled() const override { return stalled_; }
  Index stuck_nodes() const override { return problem_->stuck_nodes(); }
  void count(MemoryUse& use) const override {
    use.matrix += bytes_of(laplacian_.values);
    use.preconditioner += preconditioner_->bytes();
    use.vectors += memory_.bytes() + trial_.x.bytes() +
                   bytes_of(gradient_, preconditioned_, direction_, places_, way_,
                            preconditioned_before_, rates_, scales_, trial_.gradient);
  }
  /// The method, for reports: "L-BFGS, smoothed aggregation multigrid (4 levels)".
  std::string description() const { return "L-BFGS, " + preconditioner_->description(); }

 private:
  struct Trial {
    Coordinates x;
    double t = 0, move = 0, energy = 0;
    std::vector<double> gradient;
    Validity validity;
  };
  struct Reached {
    double residual, energy;
  };
  bool fits() const;
  void precondition(const Coordinates& x);
  bool descend(const Coordinates& x);
  void attempt(const Coordinates& x, double t);
  bool acceptable(double slope);
  bool is_slow() const;
  void take_up(Coordinates& x);
  void assess(const Coordinates& x);
  double scaled_residual() const;

  std::shared_ptr<const EnergyProblem> problem_;
  std::shared_ptr<const FirstOrderForm> form_;
  DescentOptions options_;
  std::unique_ptr<Preconditioner> preconditioner_;
  SparseMatrix laplacian_;
  CurvatureMemory memory_;
  double energy_ = 0, round_off_ = 0;
  // #rows by 3
  std::vector<double> gradient_, preconditioned_, direction_, places_;
  std::vector<double> way_, preconditioned_before_;  // of the last step
  std::vector<double> rates_;                        // #unknowns
  std::vector<double> scales_;                       // #rows, for the mesh of the last assess()
  Trial trial_;
  int since_built_ = -1;  // iterations with this preconditioner; negative: there is none yet
  double built_at_ = 0;   // scaled residual for which it was made
  bool stalled_ = false;
  std::vector<Reached> history_;  // after each step since start()
};

}  // namespace winslow
