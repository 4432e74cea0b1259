#pragma once

#include "core/formulation/distortion.h"
#include "core/formulation/surface_cells.h"
#include "core/formulation/variational_form.h"

namespace winslow {

/// The variational form on a surface mesh whose nodes stay on their surface: the energy of the
/// plane (SimplexWinslow<2>), each triangle mapped isometrically into its own plane,
///
///   E = sum_t w_t psi(f_t),   f_t = N_t / (2 d_t),   d_t = |(b - a) x (c - a)|,
///
/// with N_t from the edge lengths in space; infinite if a triangle is turned over relative to its
/// reference normal (ElementNormals, is_turned_over()). So f_t does not depend on the orientation
/// of a triangle in space, and on a plane surface this is the plane form.
///
/// The unknowns of a node are its two (on a feature line: one) directions in the tangent plane,
/// x_i(u) = foot(x_i + Q_i u). With B_t the two directions of a triangle's plane, n_t its normal,
/// and g, H gradient and Hessian of the plane,
///
///   dE/du_i = sum_t P_ti^T g_ti,   P_ti = B_t^T Q_i,
///   d2E/du_i du_j = sum_t P_ti^T H_tij P_tj + z_tij (n_t Q_i)^T (n_t Q_j)
///                   + [i = j] sum_kl (dE/dx_i . bend_kl),
///   z_tij = w psi'(f) (L_ij - f (c_i . c_j) / d) / d,
///
/// where z is the effect of normal displacements of the nodes on a triangle's edges and area (L the
/// target's graph Laplacian, c_i the edge opposite node i). The derivatives are exact, so Newton's
/// method converges quadratically.
///
/// Untangling instead projects each triangle along its reference normal, constant during a step
/// (Regularisation::normals), so that determinants have a sign.
class SurfaceWinslow final : public TargetForm<2> {
 public:
  /// See SimplexWinslow::Pattern.
  struct Pattern {
    /// classes: with element normals; every node that moves slides. targets: only their cells and
    /// the order of these matter. Throws UsageError for nodes that are free or prescribed.
    Pattern(std::shared_ptr<const NodeClasses> classes, const Targets& targets, int threads);

    NodeUnknowns nodes;
    std::shared_ptr<const SurfaceStructure> structure;
  };

  /// classes: with element normals; every node that moves slides. targets: of all cells with a node
  /// that moves. threads: 0 for all cores; no result depends on it. Throws UsageError for nodes
  /// that are free or prescribed.
  SurfaceWinslow(std::shared_ptr<const NodeClasses> classes, std::shared_ptr<const Targets> targets,
                 const PenaltyOptions& penalty, int threads)
      : SurfaceWinslow(Pattern(std::move(classes), *targets, threads), targets, penalty) {}
  /// targets: of the cells of the pattern, in the same order.
  SurfaceWinslow(const Pattern& pattern, std::shared_ptr<const Targets> targets,
                 const PenaltyOptions& penalty)
      : TargetForm(pattern.nodes, std::move(targets), penalty), structure_(pattern.structure) {}

  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override;
  /// Zero: no node is prescribed.
  Coordinates hessian_product(const Coordinates& x, const Coordinates& velocities) const override;
  void velocities_transpose(const Coordinates& x, const Coordinates& forces,
                            std::span<double> out) const override;
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override;
  std::shared_ptr<const EnergyProblem> holding_stuck_nodes(const Coordinates& x,
                                                           std::span<const double> direction,
                                                           double step) const override;
  std::shared_ptr<const VariationalForm> with_corner_lengths(const Coordinates& x) const override;
  std::unique_ptr<const TargetPath> target_path(const Coordinates& from) const override;

 private:
  enum class Second { none, exact, projected, convex };
  struct CellSums;
  struct RowSums;

  std::shared_ptr<TargetForm<2>> copy() const override {
    return std::make_shared<SurfaceWinslow>(*this);
  }
  std::size_t structure_bytes() const override { return structure_->bytes(); }
  double worst(const Coordinates& x, bool of_guards) const override;
  std::vector<Vec3> normals(const Coordinates& x) const;
  /// Maps each into its own plane; with a regularisation, along the normals in it.
  FlatCells lay_flat(const Coordinates& x, const Regularisation* regularisation) const;
  distortion::SimplexData data(const FlatCells& cells, const Regularisation* regularisation) const {
    return TargetForm::data(cells.x.data(), structure_->numbers.data(), regularisation);
  }
  double energy_of(const Coordinates& x, const Regularisation* regularisation) const override;
  std::vector<double> determinants(const Coordinates& x, Regularisation* held) const override;
  std::vector<Foot> feet(const Coordinates& x) const;
  /// For each cell, whether it is turned over.
  std::vector<bool> turned_over(const Coordinates& x) const;
  bool turned_over(std::size_t cell, const Coordinates& x) const;
  void add_nodes_that_turn(std::size_t cell, const Coordinates& x, const Coordinates& there,
                           Coordinates& y, std::vector<bool>& stuck) const;

  void sum_cells(const FlatCells& cells, const Regularisation* regularisation, Second second,
                 CellSums& out) const;
  void bend_out(const distortion::Corner2& corner, std::size_t cell, double* z) const;
  void find_blocks(const FlatCells& cells, std::span<const Foot> feet, CellSums& sums) const;
  RowSums sum_row(const FlatCells& cells, const CellSums& sums, const Foot& foot, Index row,
                  double* entries) const;
  Linearisation assemble(const Coordinates& x, const Regularisation* regularisation, bool projected,
                         SparseMatrix& hessian, std::span<double> residual) const override;
  /// hessian: null where none is wanted; residual may be empty.
  Linearisation assemble(const Coordinates& x, const Regularisation* regularisation, Second second,
                         SparseMatrix* hessian, std::span<double> residual) const;

  std::shared_ptr<const SurfaceStructure> structure_;
};

}  // namespace winslow
