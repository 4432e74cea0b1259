#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/sphere/upper_cholesky.h"

namespace winslow {

struct SphereFitOptions {
  /// mu of the first step: how much the shape of triangles counts beside their solid angles.
  double regularisation = 0.3;
  /// mu is divided by ten with every step, down to this, and the fit ends as soon as all angles are
  /// as wanted. If there is no way down, the cost is minimised as it stands.
  double least_regularisation = 1e-6;
  /// Least mean ratio, 12 (3 V)^(2/3) / (sum of the squared edges), of a tetrahedron of the VCV: 1
  /// of the regular one, 0 of a flat one. A step that leaves one below it is not taken, and the fit
  /// ends; but where the start has a flatter one, the bound is half of its mean ratio.
  double least_shape = 0.2;
  double tolerance = 1e-3;  ///< of the largest relative error of a solid angle
  int most_steps = 60;
};

/// What ended a fit.
enum class SphereFitEnd : std::uint8_t {
  converged,         ///< all solid angles are as wanted, within the tolerance
  limited_by_shape,  ///< solid angles gave way to the shape: by regularisation or least_shape
  out_of_steps
};

struct SphereFitResult {
  SphereFitEnd end = SphereFitEnd::out_of_steps;
  int steps = 0;             ///< linear systems solved
  double largest_error = 0;  ///< of |Omega / Omega* - 1|
};

/// Moves the vertices of a link on the unit sphere until its triangles have given solid angles
/// Omega*: the least, by Levenberg and Marquardt's method in the tangent planes, of
///
///   sum over triangles of (Omega / Omega* - 1)^2  +  mu / 2 sum over edges of |edge|^2.
///
/// A link of n triangles has n + 1 coordinates that are free, rotations apart, and n - 1
/// conditions, since the angles sum to 4 pi; so as a rule they can be met exactly (mu = 0), but not
/// always by triangles of a good shape. No step is taken after which a triangle has a solid angle
/// of zero or less. One object for many links keeps its memory.
class SphereFit {
 public:
  /// targets: #triangles, in steradians, positive, with a sum of 4 pi. directions: #vertices, unit
  /// vectors; where to start from, and then the result. Throws UsageError unless the start covers
  /// the sphere without an inverted triangle.
  SphereFitResult fit(const SphereLink& link, std::span<const double> targets,
                      const SphereFitOptions& options, std::span<Vec3> directions);

 private:
  /// Residuals of a set of directions and their derivatives, by corner of each triangle.
  struct State {
    std::vector<Vec3> directions;
    std::vector<double> residuals;
    std::vector<std::array<Vec3, 3>> gradients;
    double squares = 0;  ///< sum of the squares of residuals
    double edges = 0;    ///< sum of the squares of edge lengths
    double largest = 0;  ///< largest magnitude of a residual
    double shape = 1;    ///< cube of the least mean ratio, see SphereFitOptions::least_shape

    double cost(double mu) const { return squares + 0.5 * mu * edges; }
  };
  SphereFitResult iterate(const SphereLink& link, std::span<const double> targets,
                          const SphereFitOptions& options);
  bool evaluate(const SphereLink& link, std::span<const double> targets, State& state) const;
  void order_vertices(const SphereLink& link);
  void order_by_degree(const SphereLink& link);
  void assemble(const SphereLink& link, double mu);
  bool solve(double damping);
  void advance();

  State now_, trial_;
  std::vector<std::size_t> place_;             // by vertex: its place in the order of elimination
  std::vector<std::array<Vec3, 2>> tangents_;  // by vertex
  UpperCholesky normal_, factor_;
  std::vector<double> descent_, step_;
};

}  // namespace winslow
