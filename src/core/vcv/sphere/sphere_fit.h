#pragma once

#include "core/vcv/sphere/sphere_link.h"

namespace winslow {

/// Solves A x = b for a series of small symmetric positive definite matrices. Rows are contiguous,
/// so each update of the factorisation runs along two of them. Rows with a zero factor are skipped:
/// most of them, if unknowns with few neighbours come first.
class UpperCholesky {
 public:
  /// A matrix of n by n zeros.
  void reset(std::size_t n) {
    size_ = n;
    values_.assign(n * n, 0.0);
  }
  std::size_t size() const { return size_; }

  /// Entry of the upper triangle, row <= column.
  double& operator()(std::size_t row, std::size_t column) { return values_[row * size_ + column]; }
  double operator()(std::size_t row, std::size_t column) const {
    return values_[row * size_ + column];
  }

  /// A = U^T U; U replaces A, with the inverse of its diagonal. Returns false at a pivot that is
  /// not positive, with A partly factorised.
  bool factorise() {
    std::size_t j = 0;
    for (; j + 1 < size_; j += 2) {  // two rows at once: half the traffic
      const double* const first = row(j);
      const double* const second = row(j + 1);
      if (!scale(j)) return false;
      subtract(j + 1, first, first[j + 1]);
      if (!scale(j + 1)) return false;
      for (std::size_t i = j + 2; i < size_; ++i) {
        const double a = first[i], b = second[i];
        if (a == 0 && b == 0) continue;
        double* __restrict other = row(i);
        for (std::size_t k = i; k < size_; ++k) other[k] -= a * first[k] + b * second[k];
      }
    }
    return j == size_ || scale(j);
  }

  /// x = A^-1 x with the factor.
  void solve(std::span<double> x) const {
    for (std::size_t j = 0; j < size_; ++j) {
      const double* const own = row(j);
      const double value = x[j] * own[j];
      for (std::size_t k = j + 1; k < size_; ++k) x[k] -= own[k] * value;
      x[j] = value;
    }
    for (std::size_t j = size_; j-- > 0;) {
      const double* const own = row(j);
      double even = x[j], odd = 0;  // two sums: neither waits for the other
      std::size_t k = j + 1;
      for (; k + 1 < size_; k += 2) {
        even -= own[k] * x[k];
        odd -= own[k + 1] * x[k + 1];
      }
      if (k < size_) even -= own[k] * x[k];
      x[j] = (even + odd) * own[j];
    }
  }

 private:
  double* row(std::size_t j) { return values_.data() + j * size_; }
  const double* row(std::size_t j) const { return values_.data() + j * size_; }

  bool scale(std::size_t j) {
    double* const own = row(j);
    if (!(own[j] > 0)) return false;
    const double inverse = 1 / std::sqrt(own[j]);
    own[j] = inverse;
    for (std::size_t k = j + 1; k < size_; ++k) own[k] *= inverse;
    return true;
  }
  /// Subtracts the factor times another row from row i, from column i on.
  void subtract(std::size_t i, const double* other, double factor) {
    double* __restrict own = row(i);
    for (std::size_t k = i; k < size_; ++k) own[k] -= factor * other[k];
  }

  std::size_t size_ = 0;
  std::vector<double> values_;
};

/// Places the vertices of a link on the unit sphere so that no triangle is inverted, by its
/// connectivity alone:
///
/// 1. Tutte's embedding in the plane: the corners of one triangle are held, every other vertex is a
///    mean of its neighbours, weighted by the stress of the edges (W. T. Tutte, "How to draw a
///    graph", 1963; one without crossings, since the graph is 3-connected);
/// 2. its lift to a convex polyhedron (Maxwell, Cremona): the slopes of neighbouring triangles
///    differ by their edge turned by a right angle, times its stress;
/// 3. an affine map and a centre inside for which the directions to the vertices are spread evenly:
///    their mean is zero and their second moments are alike (D. E. Tyler, "A distribution-free
///    M-estimator of multivariate scatter", Ann. Stat. 15, 1987). The centre is a mean with
///    positive weights, so every iterate is valid;
/// 4. projection from the centre. Faces of a convex body seen from inside do not overlap.
///
/// An object reuses its memory for many links.
class SphereStart {
 public:
  /// directions: #vertices. Throws NumericError if round-off prevents a solution: triangles are
  /// nested so deeply that Tutte's embedding cannot resolve the innermost ones.
  void place(const SphereLink& link, std::span<Vec3> directions);

 private:
  void embed(const SphereLink& link, const SphereLink::Triangle& outer);
  void lift(const SphereLink& link, Index outer);
  void spread(std::span<Vec3> directions);

  UpperCholesky laplacian_;
  std::vector<Index> row_;     // by vertex, -1 for vertices of the outer triangle
  std::vector<double> x_, y_;  // by row
  std::vector<Vec3> points_;   // by vertex
  std::vector<Vec3> planes_;   // by triangle: slopes and height above the origin
  std::vector<Index> todo_;
  std::vector<char> reached_;
};

/// Whether all solid angles are positive and cover the sphere once.
bool covers_sphere(const SphereLink& link, std::span<const Vec3> directions);

struct SphereFitOptions {
  /// mu of the first step: the weight of the shape of triangles relative to their solid angles.
  double regularisation = 0.3;
  /// Every step divides mu by ten, down to this value; the fit ends as soon as all angles are as
  /// wanted. If no step lowers the cost, it is minimised with the present mu.
  double least_regularisation = 1e-6;
  /// Least mean ratio, 12 (3 V)^(2/3) / (sum of the squared edges), of a tetrahedron of the VCV: 1
  /// if regular, 0 if flat. A step below this bound is rejected and ends the fit. If the start has
  /// a flatter tetrahedron, the bound is half of its mean ratio.
  double least_shape = 0.2;
  double tolerance = 1e-3;  ///< of the largest relative error of a solid angle
  int most_steps = 60;
};

/// Why a fit ended.
enum class SphereFitEnd : std::uint8_t {
  converged,         ///< all solid angles are as wanted, within the tolerance
  limited_by_shape,  ///< the shape prevents the wanted angles: by regularisation or least_shape
  out_of_steps
};

struct SphereFitResult {
  SphereFitEnd end = SphereFitEnd::out_of_steps;
  int steps = 0;             ///< linear systems solved
  double largest_error = 0;  ///< of |Omega / Omega* - 1|
};

/// Moves the vertices of a link on the unit sphere until its triangles have given solid angles
/// Omega*. The Levenberg-Marquardt method in the tangent planes minimises
///
///   sum over triangles of (Omega / Omega* - 1)^2  +  mu / 2 sum over edges of |edge|^2.
///
/// A link of n triangles has n + 1 free coordinates (without rotations) and n - 1 conditions, since
/// the angles sum to 4 pi. So usually they can be met exactly (mu = 0), but not always by triangles
/// of a good shape. Steps to a solid angle of zero or less are rejected. One object for many links
/// keeps its memory.
class SphereFit {
 public:
  /// targets: #triangles, in steradians, positive, with a sum of 4 pi. directions: #vertices, unit
  /// vectors; the start on entry, the result on return. Throws UsageError unless the start covers
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
  std::vector<std::size_t> place_;             // by vertex: position in the order of elimination
  std::vector<std::array<Vec3, 2>> tangents_;  // by vertex
  UpperCholesky normal_, factor_;
  std::vector<double> descent_, step_;
};

}  // namespace winslow
