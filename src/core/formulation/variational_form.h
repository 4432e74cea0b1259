#pragma once

#include <memory>
#include <optional>

#include "core/formulation/penalty_function.h"
#include "core/problem/energy_problem.h"
#include "core/problem/node_problem.h"

namespace winslow {

class TargetPath;

/// The variational form of either dimension, as runs know it.
class VariationalForm : public NodeProblem<UntanglingProblem> {
 public:
  const PenaltyOptions& penalty() const { return penalty_; }
  /// The same with another penalty. What depends on the connectivity is shared; so are the targets.
  virtual std::shared_ptr<const VariationalForm> with_penalty(
      const PenaltyOptions& penalty) const = 0;
  /// The same with targets for which only angles count at right-angled corners of quadrilaterals
  /// and hexahedra, and at those of prisms all but the ratio of height to triangle: their edges are
  /// as long as those at x.
  ///
  /// Of a right-angled corner f is then 1 / sin in the plane, and in space the -2/3rd power of the
  /// scaled Jacobian, at x itself; and no less than that anywhere else (the mean of squares and
  /// that of logarithms). So what lowers the largest f from x on raises the smallest of these.
  virtual std::shared_ptr<const VariationalForm> with_corner_lengths(
      const Coordinates& x) const = 0;
  /// Largest f of any cell; infinite if one is inverted.
  virtual double worst_distortion(const Coordinates& x) const = 0;
  /// Targets on the way from the shapes of a valid mesh to the form's own.
  virtual std::unique_ptr<const TargetPath> target_path(const Coordinates& from) const = 0;
  /// CellTargets::stretched.
  virtual std::optional<double> stretched() const = 0;

 protected:
  VariationalForm(NodeUnknowns nodes, const PenaltyOptions& penalty)
      : NodeProblem(std::move(nodes)), penalty_(penalty) {}
  void set_penalty(const PenaltyOptions& penalty) { penalty_ = penalty; }

 private:
  PenaltyOptions penalty_;
};

/// Targets on the way from the shapes that the cells of a mesh have to those that are wanted: on
/// the geodesic between their metrics. With its own shapes for targets a mesh is the exact minimum
/// of the energy, whatever it looks like. So a path of minima begins at any valid mesh, and nothing
/// has to be relaxed before it.
class TargetPath {
 public:
  virtual ~TargetPath() = default;
  /// share: 0 (the shapes of the mesh) to 1 (as wanted).
  virtual std::shared_ptr<const VariationalForm> at_share(double share) const = 0;
};

}  // namespace winslow
