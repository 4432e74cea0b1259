#include "core/linear/reordered_matrix.h"

#include <algorithm>
#include <utility>

#include "core/linear/aggregation.h"
#include "core/linear/worthwhile.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

void ReorderedMatrix::assign(const SparseMatrix& source, int threads) {
  if (source_pattern_ != source.pattern) adopt(source.pattern);
  matrix_.block = source.block;
  matrix_.symmetric = source.symmetric;
  matrix_.values.resize(source.values.size());
  const std::size_t size = at(source.block) * at(source.block);
  parallel_for(worthwhile(threads, source.values.size()), static_cast<Index>(source_entry_.size()),
               [&](Index begin, Index end) {
                 for (auto e = at(begin); e < at(end); ++e) {
                   std::copy_n(&source.values[at(source_entry_[e]) * size], size,
                               &matrix_.values[e * size]);
                 }
               });
}

void ReorderedMatrix::adopt(std::shared_ptr<const SparsityPattern> pattern) {
  source_pattern_ = std::move(pattern);
  const SparsityPattern& p = *source_pattern_;
  order_ = locality_ordering(p);
  std::vector<Index> place(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) place[at(order_[k])] = static_cast<Index>(k);
  auto built = std::make_shared<SparsityPattern>();
  built->offsets.reserve(p.offsets.size());
  built->columns.reserve(p.columns.size());
  built->diagonal.reserve(p.diagonal.size());
  source_entry_.clear();
  source_entry_.reserve(p.columns.size());
  std::vector<std::pair<Index, Index>> row;  // column and entry
  for (std::size_t k = 0; k < order_.size(); ++k) {
    row.clear();
    const auto i = at(order_[k]);
    for (Index e = p.offsets[i]; e < p.offsets[i + 1]; ++e) {
      row.emplace_back(place[at(p.columns[at(e)])], e);
    }
    std::sort(row.begin(), row.end());
    for (const auto& [column, entry] : row) {
      if (column == static_cast<Index>(k)) {
        built->diagonal.push_back(static_cast<Index>(built->columns.size()));
      }
      built->columns.push_back(column);
      source_entry_.push_back(entry);
    }
    built->offsets.push_back(static_cast<Index>(built->columns.size()));
  }
  matrix_.pattern = std::move(built);
}

void ReorderedMatrix::gather(std::span<const double> source, int columns, int column,
                             std::span<double> vector) const {
  const auto block = at(matrix_.block), stride = at(columns);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    for (std::size_t r = 0; r < block; ++r) {
      vector[k * block + r] = source[(at(order_[k]) * block + r) * stride + at(column)];
    }
  }
}

void ReorderedMatrix::scatter(std::span<const double> vector, int columns, int column,
                              std::span<double> target) const {
  const auto block = at(matrix_.block), stride = at(columns);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    for (std::size_t r = 0; r < block; ++r) {
      target[(at(order_[k]) * block + r) * stride + at(column)] = vector[k * block + r];
    }
  }
}

}  // namespace winslow
