#include "core/formulation/gradient_parts.h"

#include <cstring>

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

constexpr std::size_t padded = 4;  // numbers a point in the kernel's arrays

/// A few numbers: std::copy_n would call a function for them.
template <std::size_t Count>
void copy(const double* from, double* to) {
  std::memcpy(to, from, Count * sizeof(double));
}

}  // namespace

GradientParts::GradientParts(const RowBlocks<3>& blocks,
                             const std::vector<std::array<Index, 4>>& cells,
                             std::span<const Index> row_of_node)
    : nodes_(at(blocks.rows())), position_(at(blocks.rows())) {
  for (Index p = 0; p < blocks.rows(); ++p) position_[at(blocks.row(p))] = p;
  for (std::size_t node = 0; node < row_of_node.size(); ++node)
    if (const Index row = row_of_node[node]; row >= 0)
      nodes_[at(position_[at(row)])] = static_cast<Index>(node);
  const auto block_end =
      static_cast<Index>(block_count(blocks.rows(), RowBlocks<3>::rows_per_block));
  parts_.resize(block_count(blocks.rows(), rows_per_part));
  std::vector<Index> local(row_of_node.size(), -1);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Part& part = parts_[k];
    const auto block = static_cast<Index>(k) * blocks_per_part;
    const Index first = static_cast<Index>(k) * rows_per_part;
    const Index end = std::min(blocks.rows(), first + rows_per_part);
    part.first_cell = blocks.first_new_cell(block);
    part.end_cell = block + blocks_per_part < block_end
                        ? blocks.first_new_cell(block + blocks_per_part)
                        : static_cast<Index>(cells.size());
    part.first_place = handed_on_;
    part.nodes.assign(nodes_.begin() + first, nodes_.begin() + end);
    part.corners.reserve(4 * at(part.end_cell - part.first_cell));
    for (Index p = first; p < end; ++p) local[at(nodes_[at(p)])] = p - first;
    for (Index t = part.first_cell; t < part.end_cell; ++t) {
      for (const Index node : cells[at(t)]) {
        if (local[at(node)] < 0) {
          local[at(node)] = static_cast<Index>(part.nodes.size());
          part.nodes.push_back(node);
          if (const Index row = row_of_node[at(node)]; row >= 0) {
            const Index p = position_[at(row)];
            parts_[at(p / rows_per_part)].received.push_back(
                {static_cast<Index>(handed_on_++), p % rows_per_part});
            part.handed_on.push_back(local[at(node)]);
          }
        }
        part.corners.push_back(local[at(node)]);
      }
    }
    for (const Index node : part.nodes) local[at(node)] = -1;
  }
  make_pattern(blocks);
}

std::size_t GradientParts::bytes() const {
  std::size_t sum = bytes_of(nodes_, position_, parts_, entry_) + bytes_of(pattern_);
  for (const Part& part : parts_)
    sum += bytes_of(part.nodes, part.corners, part.handed_on, part.received);
  return sum;
}

void GradientParts::make_pattern(const RowBlocks<3>& blocks) {
  for (Part& part : parts_) {  // these lists were as long as they grew
    part.nodes.shrink_to_fit();
    part.handed_on.shrink_to_fit();
    part.received.shrink_to_fit();
  }
  const SparsityPattern& old = *blocks.pattern();
  auto pattern = std::make_shared<SparsityPattern>();
  pattern->columns.reserve(old.columns.size());
  pattern->offsets.reserve(old.offsets.size());
  pattern->diagonal.reserve(old.diagonal.size());
  entry_.reserve(old.columns.size());
  std::vector<std::array<Index, 2>> row;  // column and entry
  Index before = 1;                       // the own matrix of a block begins with an unused entry
  for (Index p = 0; p < blocks.rows(); ++p) {
    if (p % RowBlocks<3>::rows_per_block == 0) before = 1;
    const auto old_row = at(blocks.row(p));
    row.clear();
    for (Index e = old.offsets[old_row]; e < old.offsets[old_row + 1]; ++e)
      row.push_back({position_[at(old.columns[at(e)])], before++});
    std::ranges::sort(row);
    for (const auto& [column, entry] : row) {
      if (column == p) pattern->diagonal.push_back(static_cast<Index>(entry_.size()));
      pattern->columns.push_back(column);
      entry_.push_back(entry);
    }
    pattern->offsets.push_back(static_cast<Index>(entry_.size()));
  }
  pattern_ = std::move(pattern);
}

/// The sums of all cells. x: of all nodes. add_cells(k, part, x, sums): adds those of part number k
/// to `sums`, Stride numbers for each of its nodes, of which the first are wanted.
template <std::size_t Numbers, std::size_t Stride, typename AddCells>
void GradientParts::sum(const double* x, int threads, std::span<double> out,
                        const AddCells& add_cells) const {
  const auto count = static_cast<Index>(parts_.size());
  std::vector<double> handed_on(Numbers * handed_on_);
  const auto each_part = [&](const auto& visit) {
    parallel_for(
        threads, count,
        [&](Index begin, Index end) {
          for (auto k = at(begin); k < at(end); ++k) visit(k);
        },
        1);
  };
  each_part([&](std::size_t k) {
    const Part& part = parts_[k];
    std::vector<double> own_x(padded * part.nodes.size()), sums(Stride * part.nodes.size(), 0.0);
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      copy<3>(x + 3 * static_cast<std::ptrdiff_t>(part.nodes[i]), &own_x[padded * i]);
    add_cells(k, part, own_x.data(), sums.data());
    const std::size_t first = k * at(rows_per_part);
    const std::size_t own = std::min(nodes_.size() - first, at(rows_per_part));
    for (std::size_t i = 0; i < own; ++i)
      copy<Numbers>(&sums[Stride * i], &out[Numbers * (first + i)]);
    for (std::size_t i = 0; i < part.handed_on.size(); ++i)
      copy<Numbers>(&sums[Stride * at(part.handed_on[i])],
                    &handed_on[Numbers * (part.first_place + i)]);
  });
  each_part([&](std::size_t k) {
    double* own = out.data() + Numbers * k * at(rows_per_part);
    for (const auto& [place, row] : parts_[k].received)
      for (std::size_t c = 0; c < Numbers; ++c)
        own[Numbers * at(row) + c] += handed_on[Numbers * at(place) + c];
  });
}

double GradientParts::gradient(const distortion::SimplexKernel<3>& kernel,
                               const distortion::SimplexData& data, int threads,
                               std::span<double> out) const {
  std::vector<double> energies(parts_.size());
  sum<3, padded>(data.x, threads, out,
                 [&](std::size_t k, const Part& part, const double* x, double* sums) {
                   energies[k] = kernel.add_gradients(data, x, part.corners.data(), part.first_cell,
                                                      part.end_cell, sums);
                 });
  return std::accumulate(energies.begin(), energies.end(), 0.0);
}

void GradientParts::scales(const distortion::SimplexKernel<3>& kernel,
                           const distortion::SimplexData& data, int threads,
                           std::span<double> out) const {
  constexpr std::size_t numbers = distortion::SimplexLayout<3>::scale;
  sum<numbers, numbers>(
      data.x, threads, out, [&](std::size_t, const Part& part, const double* x, double* sums) {
        kernel.add_scales(data, x, part.corners.data(), part.first_cell, part.end_cell, sums);
      });
}

void GradientParts::laplacian(const distortion::SimplexKernel<3>& kernel,
                              const distortion::SimplexData& data, const RowBlocks<3>& blocks,
                              int threads, SparseMatrix& out) const {
  constexpr Index rows_per_block = RowBlocks<3>::rows_per_block;
  constexpr std::size_t chunk = 64, size = distortion::SimplexLayout<3>::scalar_sum;
  out.pattern = pattern_;
  out.block = 1;
  out.symmetric = out.in_space = true;
  out.values.resize(pattern_->columns.size());
  const auto fill = [&](Index first, Index last) {
    const Index block = first / rows_per_block;
    const auto cells = blocks.cells(block);
    const auto places = blocks.places(block);
    std::vector<double> entries(at(blocks.entries(block)), 0.0), sums(chunk * size);
    std::vector<double> diagonals(at(rows_per_block) + 1, 0.0);
    for (std::size_t begin = 0; begin < cells.size(); begin += chunk) {
      const std::size_t count = std::min(chunk, cells.size() - begin);
      kernel.sum_scalars(data, cells.data() + begin, static_cast<Index>(count), sums.data());
      for (std::size_t i = 0; i < count; ++i) {
        const double* a = &sums[size * i];  // 11, 12, 13, 22, 23, 33
        const auto& to = places[begin + i];
        const std::array<double, 6> of_pair{
            -(a[0] + a[1] + a[2]), -(a[1] + a[3] + a[4]), -(a[2] + a[4] + a[5]), a[1], a[2], a[4]};
        constexpr std::array<std::array<std::size_t, 2>, 6> pairs{
            {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
        for (std::size_t pair = 0; pair < 6; ++pair) {
          entries[at(to.blocks[2 * pair])] += of_pair[pair];
          entries[at(to.blocks[2 * pair + 1])] += of_pair[pair];
          for (const std::size_t corner : pairs[pair]) diagonals[to.rows[corner]] -= of_pair[pair];
        }
      }
    }
    write_rows(first, last, entries, diagonals, out.values);
  };
  parallel_for(threads, blocks.rows(), fill, rows_per_block);
}

void GradientParts::write_rows(Index first, Index last, std::span<const double> entries,
                               std::span<const double> diagonals, std::span<double> values) const {
  for (auto e = at(pattern_->offsets[at(first)]); e < at(pattern_->offsets[at(last)]); ++e)
    values[e] = entries[at(entry_[e])];
  for (Index p = first; p < last; ++p)
    values[at(pattern_->diagonal[at(p)])] = diagonals[at(p - first)];
}

}  // namespace winslow
