#pragma once

#include <cmath>
#include <functional>

#include "core/formulation/cell_targets.h"
#include "core/formulation/simplex_kernel.h"
#include "core/problem/node_unknowns.h"
#include "core/problem/smoothing_problem.h"

namespace winslow {

/// Shape of psi.
struct PenaltyOptions {
  double exponent = 8;  ///< p >= 1
  double knee = 1.78;   ///< distortion f from which the power takes effect, > 1; 0: psi(f) = f^p
  double bound = 0;     ///< if positive psi(f) = f / (1 - f / bound), infinite from the bound on
  double raise = 1;     ///< factor of the knee and of the limits of guards, >= 1
  /// Weight of guards (CellTargets::inverse_limits). They have no effect without a knee, with a
  /// bound, or with an exponent up to 2.
  double guard = 0.1;

  bool operator==(const PenaltyOptions&) const = default;
};

namespace distortion {

/// psi(f) = f + (f / knee)^p, or f^p without a knee, or f / (1 - f / bound): its first two
/// derivatives. With guards psi(f) = f for the other terms; for the guards see PenaltyConstants.
struct PenaltySlopes {
  double first, second;
};

class PenaltyFunction {
 public:
  /// guarded: whether the form has guards.
  explicit PenaltyFunction(const PenaltyOptions& options, bool guarded = false) {
    const auto [exponent, knee, bound, raise, guard] = options;
    const double whole = std::round(exponent);
    const bool is_small_natural = whole == exponent && whole >= 2 && whole <= 32;
    constants_ = {exponent, knee > 0 ? 1.0 : 0.0,
                  knee > 0 ? std::pow(knee * raise, -exponent) : 1.0,
                  is_small_natural ? static_cast<int>(whole) - 2 : -1, bound > 0 ? 1 / bound : 0.0};
    if (!guarded || knee == 0 || bound > 0) return;
    constexpr double steepest = 2;
    constants_.scale = 0;
    constants_.guard = exponent > 2 ? guard : 0;
    constants_.limit_share = 1 / raise;
    constants_.steepest = steepest;
  }

  const PenaltyConstants& constants() const { return constants_; }
  /// inverse_limit: of a guard; 0: of another term.
  PenaltySlopes slopes(double f, double inverse_limit = 0) const {
    if (inverse_limit > 0) return slopes_of_guard(f, inverse_limit * constants_.limit_share);
    if (constants_.inverse_bound > 0) {
      const double growth = 1 / (1 - constants_.inverse_bound * f);
      return {growth * growth, 2 * constants_.inverse_bound * growth * growth * growth};
    }
    const double p = constants_.exponent;
    const double power = constants_.scale * std::pow(f, p - 2);
    return {constants_.linear + p * power * f, p * (p - 1) * power};
  }

 private:
  PenaltySlopes slopes_of_guard(double f, double share) const {
    const double seen = share * f, p = constants_.exponent;
    const double r = std::clamp(seen, 1.0, constants_.steepest);
    const double power = std::pow(r, p - 2);
    const double bend = seen < constants_.steepest ? p * (p - 1) * (power - 1) : 0;
    return {constants_.guard * share * p * (power * r - 1 - (p - 1) * (r - 1)),
            constants_.guard * share * share * bend};
  }

  PenaltyConstants constants_;
};

}  // namespace distortion

class TargetPath;

/// The variational form of either dimension: the interface for runs.
class VariationalForm : public NodeProblem<UntanglingProblem> {
 public:
  const PenaltyOptions& penalty() const { return penalty_; }
  /// The same with another penalty. The targets and the data that depend on the connectivity are
  /// shared.
  virtual std::shared_ptr<const VariationalForm> with_penalty(
      const PenaltyOptions& penalty) const = 0;
  /// The same with the edge lengths at x in the targets of right-angled corners. Then only the
  /// angles count in quadrilaterals and hexahedra; in prisms all but the ratio of height to
  /// triangle.
  ///
  /// At x, f of a right-angled corner is then 1 / sin in the plane, and the -2/3rd power of the
  /// scaled Jacobian in space; elsewhere f is at least as large (the mean of squares and that of
  /// logarithms). So a decrease of the largest f from x raises the smallest of these.
  virtual std::shared_ptr<const VariationalForm> with_corner_lengths(
      const Coordinates& x) const = 0;
  /// Largest f of any term, guards left out; infinite if a cell is inverted.
  double worst_distortion(const Coordinates& x) const { return worst(x, false); }
  /// Largest f of any term in knees; of a form with guards, the largest f of a guard in its limit.
  /// As if nothing was raised. knee: not 0. Infinite if a cell is inverted.
  double strain(const Coordinates& x, double knee) const {
    return has_guards() ? worst(x, true) : worst(x, false) / knee;
  }
  /// Whether some terms are guards: CellTargets::inverse_limits.
  virtual bool has_guards() const = 0;
  /// Targets on the way from the shapes of a valid mesh to the form's own.
  virtual std::unique_ptr<const TargetPath> target_path(const Coordinates& from) const = 0;
  /// CellTargets::stretched.
  virtual std::optional<double> stretched() const = 0;
  /// CellTargets::without_shape.
  virtual Index without_shape() const = 0;
  /// Adds the memory of its targets, and of the data that depend on the connectivity.
  virtual void count(MemoryUse& use) const = 0;

  /// d2E/dx2 v, over all nodes as if each had its own unknowns. velocities: v, as large as x.
  /// Throws UsageError for a surface mesh, whose boundary does not move.
  virtual Coordinates hessian_product(const Coordinates& x,
                                      const Coordinates& velocities) const = 0;
  /// The transpose of velocities(): `forces` on all nodes (as large as x) as those along the
  /// unknowns (#unknowns).
  virtual void velocities_transpose(const Coordinates& x, const Coordinates& forces,
                                    std::span<double> out) const = 0;

 protected:
  VariationalForm(NodeUnknowns nodes, const PenaltyOptions& penalty)
      : NodeProblem(std::move(nodes)), penalty_(penalty) {}
  void set_penalty(const PenaltyOptions& penalty) { penalty_ = penalty; }

 private:
  /// Largest f of any term but guards. of_guards: largest f of a guard in its limit. Infinite if a
  /// cell is inverted.
  virtual double worst(const Coordinates& x, bool of_guards) const = 0;

  PenaltyOptions penalty_;
};

/// The common part of variational forms over targets of triangles (D = 2) or tetrahedra (D = 3), in
/// the plane, in space or on surfaces. Derived classes compute the corners of the cells and turn
/// sums over cells into rows of the unknowns.
template <int D>
class TargetForm : public VariationalForm {
 public:
  using Targets = CellTargets<D>;

  std::string_view name() const final { return "variational"; }
  std::shared_ptr<const VariationalForm> with_penalty(const PenaltyOptions& penalty) const final;
  /// The same with other targets of the same cells, in the order of shapes().
  std::shared_ptr<const TargetForm> with_shapes(std::shared_ptr<const Targets> shapes) const;
  const Targets& shapes() const { return *shapes_; }
  std::optional<double> stretched() const final { return shapes_->stretched; }
  Index without_shape() const final { return shapes_->without_shape; }
  bool has_guards() const final { return !shapes_->inverse_limits.empty(); }
  void count(MemoryUse& use) const final {
    use.targets += shapes_->bytes();
    use.structure += structure_bytes();
  }

  double energy(const Coordinates& x) const final { return energy_of(x, nullptr); }
  double regularised_energy(const Coordinates& x,
                            const Regularisation& regularisation) const final {
    return energy_of(x, &regularisation);
  }
  Linearisation linearise(const Coordinates& x, Curvature curvature, SparseMatrix& hessian,
                          std::span<double> residual) const final {
    return assemble(x, nullptr, curvature == Curvature::projected, hessian, residual);
  }
  Linearisation linearise_regularised(const Coordinates& x, const Regularisation& regularisation,
                                      SparseMatrix& hessian,
                                      std::span<double> residual) const final {
    return assemble(x, &regularisation, false, hessian, residual);
  }
  std::vector<double> cell_sizes(const Coordinates& x) const final;
  Regularisation regularisation(const Coordinates& x, std::span<const double> sizes,
                                const Softness& softness) const final;
  Regularisation full_regularisation(const Coordinates& x) const final;
  Index stuck_nodes() const final;

 protected:
  TargetForm(NodeUnknowns nodes, std::shared_ptr<const Targets> shapes,
             const PenaltyOptions& penalty)
      : VariationalForm(std::move(nodes), penalty), shapes_(std::move(shapes)) {}

  virtual std::shared_ptr<TargetForm> copy() const = 0;
  /// The targets of a form that nobody else has yet, to be changed. Copies them if others have
  /// them.
  Targets& own_shapes() {
    if (shapes_.use_count() != 1) shapes_ = std::make_shared<Targets>(*shapes_);
    return const_cast<Targets&>(*shapes_);
  }
  /// Bytes of the data that depend on the connectivity.
  virtual std::size_t structure_bytes() const = 0;
  /// regularisation: null for the determinants themselves, as for assemble().
  virtual double energy_of(const Coordinates& x, const Regularisation* regularisation) const = 0;
  /// With a regularisation, or projected, the Hessian is positive semidefinite.
  virtual Linearisation assemble(const Coordinates& x, const Regularisation* regularisation,
                                 bool projected, SparseMatrix& hessian,
                                 std::span<double> residual) const = 0;
  /// Determinants of all cells. held: receives the other data of a regularisation, and the
  /// determinants are those used with it; null: the determinants are those of the energy.
  virtual std::vector<double> determinants(const Coordinates& x, Regularisation* held) const = 0;

  /// Input of the kernel. points, nodes: of all cells.
  distortion::SimplexData data(const double* points, const Index* nodes,
                               const Regularisation* regularisation) const {
    return data(*shapes_, points, nodes, regularisation);
  }
  /// The same for other targets, of any cells, with the form's penalty.
  distortion::SimplexData data(const Targets& targets, const double* points, const Index* nodes,
                               const Regularisation* regularisation) const;
  /// The energy of all cells.
  double sum_energy(const distortion::SimplexData& cells) const;
  /// The largest of some numbers of all cells, not negative.
  double largest_of_cells(const std::function<double(std::size_t)>& of_cell) const;
  /// worst() for derived classes. corner(cell): its Corner.
  template <typename CornerOf>
  double worst_of(const CornerOf& corner, bool of_guards) const {
    const auto of_cell = [&](std::size_t t) {
      double worst = 0;
      const auto seen = corner(t);
      for (auto k = at(shapes_->offsets[t]); k < at(shapes_->offsets[t + 1]); ++k) {
        const double f = seen.distortion(shapes_->terms[k]);
        if (!(f > 0)) return std::numeric_limits<double>::infinity();
        const double inverse_limit = shapes_->inverse_limit(k);
        if ((inverse_limit > 0) == of_guards)
          worst = std::max(worst, of_guards ? f * inverse_limit : f);
      }
      return worst;
    };
    return largest_of_cells(of_cell);
  }
  const distortion::SimplexKernel<D>& kernel() const { return kernel_; }
  distortion::PenaltyFunction psi() const {
    return distortion::PenaltyFunction(this->penalty(), has_guards());
  }

  /// For each row (#nodes with unknowns) whether its sliding node is held; empty: none is.
  const std::vector<bool>& stuck() const { return stuck_; }
  /// The same, with false for every row instead of an empty vector.
  std::vector<bool> stuck_rows() const;
  /// The same problem with these rows held; null if this problem already holds them all.
  std::shared_ptr<const EnergyProblem> holding(std::vector<bool> stuck) const;

 private:
  std::shared_ptr<const Targets> shapes_;
  std::vector<bool> stuck_;
  const distortion::SimplexKernel<D>& kernel_ = distortion::fastest_kernel<D>();
};

extern template class TargetForm<2>;
extern template class TargetForm<3>;

/// Targets between the shapes of a mesh and the wanted ones: on the geodesic between their metrics.
/// With its own shapes as targets every valid mesh is an exact minimum of the energy. So a path of
/// minima can begin at any valid mesh, without a relaxation before it.
class TargetPath {
 public:
  virtual ~TargetPath() = default;
  /// share: 0 (the shapes of the mesh) to 1 (as wanted).
  virtual std::shared_ptr<const VariationalForm> at_share(double share) const = 0;
};

}  // namespace winslow
