#include "core/formulation/sliding_rows.h"

#include <Eigen/Eigenvalues>

namespace winslow {

namespace {

template <int D>
using Block = Eigen::Matrix<double, D, D, Eigen::RowMajor>;

/// Columns: the directions of a foot; zero for those that it has not.
template <int D>
Block<D> directions(const Foot& foot) {
  Block<D> q = Block<D>::Zero();
  for (int k = 0; k < std::min(foot.frame.count(), D); ++k)
    q.col(k) = foot.frame[k].template head<D>();
  return q;
}

template <int D>
Eigen::Map<Block<D>> block_of(SparseMatrix& matrix, Index entry) {
  return Eigen::Map<Block<D>>(&matrix.values[at(entry) * D * D]);
}

Index find_entry(const SparsityPattern& pattern, Index row, Index column) {
  const auto first = pattern.columns.begin() + pattern.offsets[at(row)];
  const auto last = pattern.columns.begin() + pattern.offsets[at(row) + 1];
  return static_cast<Index>(std::lower_bound(first, last, column) - pattern.columns.begin());
}

}  // namespace

Eigen::Matrix2d bending(const Foot& foot, const Vec3& gradient, bool convex) {
  Eigen::Matrix2d m;
  m << gradient.dot(foot.bend[0]), gradient.dot(foot.bend[1]), gradient.dot(foot.bend[1]),
      gradient.dot(foot.bend[2]);
  if (!convex || m.isZero(0)) return m;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(m);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

template <int D>
SlidingRows<D>::SlidingRows(const NodeUnknowns& nodes, const SparsityPattern& pattern) {
  for (std::size_t i = 0; i < nodes.nodes().size(); ++i) {
    if (!nodes.classes().slides(nodes.nodes()[i])) continue;
    if (slot_.empty()) slot_.assign(at(pattern.rows()), -1);
    slot_[i] = static_cast<Index>(rows_.size());
    rows_.push_back(static_cast<Index>(i));
  }
}

template <int D>
std::vector<Foot> SlidingRows<D>::feet(const NodeUnknowns& nodes, const Coordinates& x) const {
  std::vector<Foot> feet;
  feet.reserve(rows_.size());
  for (const Index row : rows_) {
    const Index node = nodes.nodes()[at(row)];
    Vec3 point(0, 0, 0);
    point.template head<D>() = x.get<D>(node);
    feet.push_back(nodes.classes().foot(node, point));
  }
  return feet;
}

template <int D>
double SlidingRows<D>::along(const Foot& foot, const double* v) {
  const Eigen::Map<const Vec<D>> vector(v);
  return (directions<D>(foot).transpose() * vector).norm();
}

template <int D>
void SlidingRows<D>::restrict(std::span<const Foot> feet, std::span<double> residual) const {
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    Eigen::Map<Vec<D>> own(residual.data() + D * at(rows_[s]));
    own = (directions<D>(feet[s]).transpose() * own).eval();
  }
}

template <int D>
void SlidingRows<D>::restrict(std::span<const Foot> feet, std::span<const double> residual,
                              bool convex, SparseMatrix& matrix) const {
  const SparsityPattern& pattern = *matrix.pattern;
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    const Index row = rows_[s];
    const Foot& foot = feet[s];
    const Block<D> q = directions<D>(foot);
    const double scale = block_of<D>(matrix, pattern.diagonal[at(row)]).trace() / D;
    for (Index e = pattern.offsets[at(row)]; e < pattern.offsets[at(row) + 1]; ++e) {
      auto left = block_of<D>(matrix, e);
      left = (q.transpose() * left).eval();
      auto right = block_of<D>(matrix, find_entry(pattern, pattern.columns[at(e)], row));
      right = (right * q).eval();
    }
    auto diagonal = block_of<D>(matrix, pattern.diagonal[at(row)]);
    Vec3 gradient(0, 0, 0);
    for (int k = 0; k < D; ++k) gradient[k] = -residual[D * at(row) + at(k)];
    const Eigen::Matrix2d bend = bending(foot, gradient, convex);
    const int unknowns = foot.frame.count();
    const int bends = std::min(unknowns, 2);
    diagonal.topLeftCorner(bends, bends) += bend.topLeftCorner(bends, bends);
    for (int k = unknowns; k < D; ++k) diagonal(k, k) = scale;
    diagonal = (0.5 * (diagonal + diagonal.transpose())).eval();
  }
}

template class SlidingRows<2>;
template class SlidingRows<3>;

}  // namespace winslow
