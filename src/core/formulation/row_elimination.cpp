#include "core/formulation/row_elimination.h"

#include <Eigen/Eigenvalues>

#include "core/linear/pattern_builder.h"
#include "core/mesh/coordinates.h"

namespace winslow {

namespace {

/// Makes a zero matrix of D by D blocks in the given pattern, with the properties of another.
template <int D>
void set_zero(const SparseMatrix& like, const std::shared_ptr<const SparsityPattern>& pattern,
              SparseMatrix& out) {
  out.pattern = pattern;
  out.block = D;
  out.symmetric = like.symmetric;
  out.in_space = like.in_space;
  out.values.assign(at(D) * at(D) * pattern->columns.size(), 0.0);
}

}  // namespace

template <int D>
FollowerRows<D>::FollowerRows(const NodeUnknowns& nodes, std::span<const Index> row_of_node,
                              std::shared_ptr<const SparsityPattern> full)
    : own_(nodes.nodes().size() + nodes.images().size()), full_(std::move(full)), pattern_(full_) {
  for (const auto& row : nodes.rows()) {
    std::array<Index, 2> ends{row_of_node[at(row->first())], row_of_node[at(row->last())]};
    if (row->closed()) ends[1] = -1;
    ends_.insert(ends_.end(), row->between().size(), ends);
  }
  if (empty()) return;
  const std::size_t all = own_ + ends_.size();
  part_.assign(all, 0);
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    part_[own_ + k] = 1;
    for (const Index end : ends_[k])
      if (end >= 0) part_[at(end)] = 1;
  }
  std::vector<std::vector<Index>> columns(own_);
  for (std::size_t i = 0; i < all; ++i)
    for (auto e = at(full_->offsets[i]); e < at(full_->offsets[i + 1]); ++e)
      for (const Index row : rows(i))
        for (const Index column : rows(at(full_->columns[e])))
          if (row >= 0 && column >= 0) columns[at(row)].push_back(column);
  pattern_ = pattern_of(std::move(columns));
}

template <int D>
std::vector<typename FollowerRows<D>::Lever> FollowerRows<D>::levers(const NodeUnknowns& nodes,
                                                                     const Coordinates& x) const {
  std::vector<Lever> out;
  out.reserve(ends_.size());
  for (const auto& row : nodes.rows()) {
    const auto places = row->places(place_of(x, row->first()), place_of(x, row->last()));
    for (std::size_t k = 0; k < places.between.size(); ++k) {
      const double last = row->part_of_last(k);
      const CurvePoint<3>& place = places.between[k];
      out.push_back({place.tangent.template head<D>(),
                     place.curvature.template head<D>(),
                     {(1 - last) * places.first.tangent.template head<D>(),
                      last * places.last.tangent.template head<D>()}});
    }
  }
  return out;
}

template <int D>
typename FollowerRows<D>::Parts FollowerRows<D>::parts_of(std::span<const Lever> levers,
                                                          std::size_t full_row) const {
  Parts out;
  if (full_row < own_) {
    out.parts[0] = {static_cast<Index>(full_row), Block::Identity()};
    out.count = 1;
    return out;
  }
  const Lever& lever = levers[full_row - own_];
  for (std::size_t m = 0; m < 2; ++m) {
    const Index end = ends_[full_row - own_][m];
    if (end >= 0)
      out.parts[static_cast<std::size_t>(out.count++)] = {
          end, Block(lever.tangent * lever.ends[m].transpose())};
  }
  return out;
}

template <int D>
void FollowerRows<D>::reduce(std::span<const Lever> levers, std::span<const double> full,
                             std::span<double> out) const {
  std::copy_n(full.begin(), out.size(), out.begin());
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    const double along =
        levers[k].tangent.dot(Eigen::Map<const Vec<D>>(full.data() + D * (own_ + k)));
    for (std::size_t m = 0; m < 2; ++m) {
      if (ends_[k][m] < 0) continue;
      Eigen::Map<Vec<D>> own(out.data() + D * at(ends_[k][m]));
      own += along * levers[k].ends[m];
    }
  }
}

template <int D>
void FollowerRows<D>::reduce(std::span<const Lever> levers, std::span<const double> residual,
                             bool convex, const SparseMatrix& full, SparseMatrix& out) const {
  constexpr std::size_t size = std::size_t{D} * D;  // of a block
  set_zero<D>(full, pattern_, out);
  const auto to = [&](Index row, Index column) {
    return Eigen::Map<Block>(&out.values[at(pattern_->find(row, column)) * size]);
  };
  for (std::size_t i = 0; i < own_ + ends_.size(); ++i) {
    const Parts left = parts_of(levers, i);
    for (auto e = at(full_->offsets[i]); e < at(full_->offsets[i + 1]); ++e) {
      const Eigen::Map<const Block> from(&full.values[e * size]);
      const auto column = at(full_->columns[e]);
      if (i < own_ && column < own_) {
        to(static_cast<Index>(i), static_cast<Index>(column)) += from;
        continue;
      }
      const Parts right = parts_of(levers, column);
      for (std::size_t a = 0; a < static_cast<std::size_t>(left.count); ++a)
        for (std::size_t b = 0; b < static_cast<std::size_t>(right.count); ++b)
          to(left.parts[a].row, right.parts[b].row) +=
              left.parts[a].block.transpose() * from * right.parts[b].block;
    }
  }
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    const Eigen::Map<const Vec<D>> r(residual.data() + D * (own_ + k));
    const double bend = -r.dot(levers[k].curvature);
    if (bend == 0 || (convex && bend < 0)) continue;
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t b = 0; b < 2; ++b)
        if (ends_[k][a] >= 0 && ends_[k][b] >= 0)
          to(ends_[k][a], ends_[k][b]) += bend * levers[k].ends[a] * levers[k].ends[b].transpose();
  }
}

template class FollowerRows<2>;
template class FollowerRows<3>;

template <int D>
PeriodicRows<D>::PeriodicRows(const NodeUnknowns& nodes,
                              std::shared_ptr<const SparsityPattern> full)
    : own_(nodes.nodes().size()), full_(std::move(full)), pattern_(full_) {
  const auto images = nodes.images();
  if (images.empty()) return;
  const std::size_t all = own_ + images.size();
  row_.resize(all);
  part_.assign(all, 0);
  for (std::size_t i = 0; i < own_; ++i) row_[i] = static_cast<Index>(i);
  for (std::size_t k = 0; k < images.size(); ++k) {
    const auto found = std::ranges::lower_bound(nodes.nodes(), images[k].node);
    const auto master = found - nodes.nodes().begin();
    row_[own_ + k] = static_cast<Index>(master);
    part_[own_ + k] = part_[static_cast<std::size_t>(master)] = 1;
    rotation_.push_back(images[k].transform->rotation.template topLeftCorner<D, D>());
  }
  std::vector<std::vector<Index>> columns(own_);
  for (std::size_t i = 0; i < all; ++i)
    for (auto e = at(full_->offsets[i]); e < at(full_->offsets[i + 1]); ++e)
      columns[at(row_[i])].push_back(row_[at(full_->columns[e])]);
  auto reduced = pattern_of(std::move(columns));
  for (std::size_t i = 0; i < all; ++i)
    for (auto e = at(full_->offsets[i]); e < at(full_->offsets[i + 1]); ++e) {
      entry_.push_back(reduced->find(row_[i], row_[at(full_->columns[e])]));
      row_of_entry_.push_back(static_cast<Index>(i));
    }
  pattern_ = std::move(reduced);
}

template <int D>
void PeriodicRows<D>::reduce(std::span<const double> full, std::span<double> out) const {
  std::copy_n(full.begin(), out.size(), out.begin());
  for (std::size_t k = 0; k < rotation_.size(); ++k) {
    const Eigen::Map<const Vec<D>> image(full.data() + D * (own_ + k));
    Eigen::Map<Vec<D>> own(out.data() + D * at(row_[own_ + k]));
    own += rotation_[k].transpose() * image;
  }
}

template <int D>
void PeriodicRows<D>::reduce(const SparseMatrix& full, SparseMatrix& out) const {
  constexpr std::size_t size = std::size_t{D} * D;  // of a block
  set_zero<D>(full, pattern_, out);
  for (std::size_t e = 0; e < entry_.size(); ++e) {
    const Eigen::Map<const Block> from(&full.values[e * size]);
    Eigen::Map<Block> to(&out.values[at(entry_[e]) * size]);
    const Block* left = rotation(at(row_of_entry_[e]));
    const Block* right = rotation(at(full_->columns[e]));
    Block block = from;
    if (left) block = (left->transpose() * block).eval();
    if (right) block = (block * *right).eval();
    to += block;
  }
}

template class PeriodicRows<2>;
template class PeriodicRows<3>;

namespace {

template <int D>
using Block = Eigen::Matrix<double, D, D, Eigen::RowMajor>;

/// Columns: the directions of a foot; zero columns for missing directions.
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
      auto right = block_of<D>(matrix, pattern.find(pattern.columns[at(e)], row));
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
