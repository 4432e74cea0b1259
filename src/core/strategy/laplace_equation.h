#pragma once

#include "core/linear/linear_solver.h"
#include "core/linear/sparse_system.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// Extends fields from the nodes where they are known to all other nodes:
///
///     LaplaceEquation equation(topology, x, known, threads);
///     equation.solve({.exponent = 3}, fields);
///
/// The p-Laplace equation div (|grad u|^(p-2) grad u) = 0 by linear finite elements with quadrature
/// at the corners: there the gradients are those on the corner simplices. For p = 2 the gradient of
/// a field is largest where the mesh is narrow; for larger p it is spread more evenly.
class LaplaceEquation {
 public:
  struct Options {
    double exponent = 2;     ///< p, from 2 to 3
    double accuracy = 1e-4;  ///< relative residual of the last linear solve
  };

  /// known: #nodes, whether the values at a node are known. Nodes of no element count as known.
  /// topology and x outlive the equation. threads: 0 for all cores; no result depends on it.
  LaplaceEquation(const Topology& topology, const Coordinates& x, const std::vector<bool>& known,
                  int threads);

  /// fields: each #nodes, with the known values and a first guess of the others on entry. All have
  /// the same conductivity |grad u|^(p-2), in which |grad u|^2 is the sum over the fields. A part
  /// of the mesh without known values gets zero. For p > 2 the conductivity is that of the third
  /// iterate (frozen conductivities, averaged geometrically): close to the solution, and smooth.
  void solve(const Options& options, std::vector<std::vector<double>>& fields);

 private:
  template <typename Work>
  void each_row(const Work& work) const;
  template <int D>
  void make_elements();
  void update_conductivity(const std::vector<std::vector<double>>& fields, double exponent);
  void assemble(const std::vector<std::vector<double>>& fields);
  void solve_assembled(double accuracy, std::vector<std::vector<double>>& fields);

  const Topology& topology_;
  const Coordinates& x_;
  int threads_;
  std::vector<Index> numbers_;        // #nodes, of the unknowns; -1: none
  std::vector<Index> nodes_;          // that have unknowns
  std::vector<Index> apart_;          // in parts of the mesh without a known value
  std::vector<double> conductivity_;  // #elements; empty: 1
  struct Elements {
    std::vector<std::size_t> first_pair;  // #elements + 1
    std::vector<double> of_pair;          // entries of their matrices, for a conductivity of 1
    std::vector<double> volume;           // #elements
  };
  Elements elements_;  // during solve()
  SparseMatrix matrix_;
  std::vector<std::vector<double>> right_hand_sides_;  // of each field
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace winslow
