#include "core/formulation/periodic_rows.h"

#include <algorithm>

#include "core/linear/pattern_builder.h"

namespace winslow {

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
  for (std::size_t i = 0; i < all; ++i) {
    const auto first = reduced->columns.begin() + reduced->offsets[at(row_[i])];
    const auto last = reduced->columns.begin() + reduced->offsets[at(row_[i]) + 1];
    for (auto e = at(full_->offsets[i]); e < at(full_->offsets[i + 1]); ++e) {
      const auto place = std::lower_bound(first, last, row_[at(full_->columns[e])]);
      entry_.push_back(static_cast<Index>(place - reduced->columns.begin()));
      row_of_entry_.push_back(static_cast<Index>(i));
    }
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
  out.pattern = pattern_;
  out.block = D;
  out.symmetric = full.symmetric;
  out.in_space = full.in_space;
  constexpr std::size_t size = std::size_t{D} * D;  // of a block
  out.values.assign(size * pattern_->columns.size(), 0.0);
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

}  // namespace winslow
