#include "core/formulation/tetrahedron_distortion.h"

#include <Eigen/SVD>
#include <cmath>

namespace winslow::distortion {

namespace {

using Eigen::Matrix3d;

/// Adds lambda z z^T over the nodes of a tetrahedron, z the gradients over its edges (columns).
void add_rank_one(double lambda, const Matrix3d& z, double* blocks) {
  if (!(lambda > 0)) return;
  Eigen::Matrix<double, 3, 4> of_node;
  of_node.col(0) = -z.rowwise().sum();
  of_node.rightCols<3>() = z;
  using Block = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b, blocks += 9)
      Block(blocks) += lambda * of_node.col(a) * of_node.col(b).transpose();
  }
}

}  // namespace

Corner3::Corner3(const std::array<Vec3, 4>& p) {
  for (int k = 0; k < 3; ++k) edges.col(k) = p[static_cast<std::size_t>(k + 1)] - p[0];
  d = edges.determinant();
}

double Corner3::distortion(const VolumeTerm& term) const {
  const double s = (edges.transpose() * edges).cwiseProduct(metric_of(term)).sum();
  return d > 0 ? s / (3 * std::cbrt(d) * std::cbrt(d)) : -1;
}

void add_projected_blocks(const Corner3& q, const VolumeTerm& term, const PenaltyFunction& psi,
                          double* blocks) {
  // A = root root^T: J = E root.
  const Matrix3d root = metric_of(term).llt().matrixL();
  const Eigen::JacobiSVD<Matrix3d> svd(q.edges * root, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d &u = svd.matrixU(), &v = svd.matrixV();
  Vec3 sigma = svd.singularValues();
  const double s = sigma.squaredNorm();
  const double f = q.distortion(term);
  const PenaltySlopes slopes = psi.slopes(f);
  const double first = term.weight * slopes.first * f;
  const auto add = [&](double lambda, const Matrix3d& over_singular) {
    add_rank_one(lambda, u * over_singular * v.transpose() * root.transpose(), blocks);
  };
  // dpsi/dsigma_i = first (2 sigma_i / s - (2/3) / sigma_i); twist: the sum of two of these over
  // the sum of the values; flip: the difference over the difference.
  const double half_root = std::sqrt(0.5);
  for (int i = 0; i < 3; ++i) {
    for (int j = i + 1; j < 3; ++j) {
      const double product = 1.5 * sigma[i] * sigma[j];
      Matrix3d twist = Matrix3d::Zero(), flip = Matrix3d::Zero();
      twist(i, j) = half_root;
      twist(j, i) = -half_root;
      flip(i, j) = flip(j, i) = half_root;
      add(first * (2 / s - 1 / product), twist);
      add(first * (2 / s + 1 / product), flip);
    }
  }
  const Vec3 w = sigma.cwiseInverse(), slope = 2 / s * sigma - 2.0 / 3.0 * w;
  const double second = term.weight * slopes.second * f * f;
  Matrix3d scaling = (first + second) * slope * slope.transpose() -
                     4 * first / (s * s) * sigma * sigma.transpose();
  scaling.diagonal().array() += first * (2 / s + 2.0 / 3.0 * w.array().square());
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(scaling);
  for (int k = 0; k < 3; ++k) add(eigen.eigenvalues()[k], eigen.eigenvectors().col(k).asDiagonal());
}

}  // namespace winslow::distortion
