#pragma once

#include <tuple>

#include "core/formulation/cell_targets.h"
#include "core/formulation/row_elimination.h"
#include "core/formulation/simplex_kernel.h"
#include "core/linear/pattern_builder.h"
#include "core/linear/sparse_system.h"
#include "core/mesh/index_sets.h"
#include "core/problem/node_unknowns.h"
#include "core/types.h"

namespace winslow {

/// For each row, the cell corners at its node: N * cell + corner, ascending. row_of_node: -1 for
/// nodes without a row.
template <std::size_t N>
CompressedRows corners_of_rows(const std::vector<std::array<Index, N>>& cells,
                               std::span<const Index> row_of_node, Index rows) {
  index_count(N * cells.size(), "corners of the cells of targets");
  CompressedRows corners;
  corners.offsets.assign(at(rows) + 1, 0);
  const auto each_corner = [&](const auto& visit) {
    for (std::size_t t = 0; t < cells.size(); ++t)
      for (std::size_t c = 0; c < N; ++c)
        if (const Index row = row_of_node[at(cells[t][c])]; row >= 0)
          visit(at(row), static_cast<Index>(N * t + c));
  };
  each_corner([&](std::size_t row, Index) { ++corners.offsets[row + 1]; });
  add_up(corners.offsets, "corners of the cells of targets");
  corners.values.resize(at(corners.offsets.back()));
  std::vector<Index> next = corners.offsets;
  each_corner([&](std::size_t row, Index corner) { corners.values[at(next[row]++)] = corner; });
  return corners;
}

/// The pattern with an entry for every pair of rows with a common cell. corners: see
/// corners_of_rows().
template <std::size_t N>
std::shared_ptr<SparsityPattern> pattern_of_cells(const std::vector<std::array<Index, N>>& cells,
                                                  const CompressedRows& corners,
                                                  std::span<const Index> row_of_node, int threads) {
  const auto begin_block = [&] {
    // seen[r]: the row that listed row r last
    return [&, seen = std::vector<Index>(at(corners.rows()), -1)](
               Index row, std::vector<Index>& columns) mutable {
      const auto add = [&](Index other) {
        if (other >= 0 && std::exchange(seen[at(other)], row) != row) columns.push_back(other);
      };
      add(row);
      for (const Index corner : corners[row])
        for (const Index node : cells[at(corner) / N]) add(row_of_node[at(node)]);
    };
  };
  return build_pattern(corners.rows(), few_blocks(corners.rows()), threads, begin_block);
}

/// The free nodes (rows) in spatially compact blocks, with the cells (triangles in the plane,
/// tetrahedra in space) around each block. The results for a cell serve all rows of a block while
/// they are in the cache. A cell between two blocks is computed in both, so blocks in space, which
/// have more surface, are larger. Mesh generators number nodes almost at random, so the blocks have
/// their own order of the nodes.
template <int D>
class RowBlocks {
 public:
  using Cell = std::array<Index, D + 1>;
  static constexpr Index rows_per_block = D == 2 ? 256 : 512;  // a divisor of parallel_block

  /// cells: nodes. row_of_node: -1 for nodes without unknowns.
  RowBlocks(const std::vector<Cell>& cells, std::span<const Index> row_of_node, Index rows,
            int threads);

  /// D by D blocks for every pair of free nodes with a common cell.
  const std::shared_ptr<const SparsityPattern>& pattern() const { return pattern_; }
  Index rows() const { return static_cast<Index>(order_.size()); }
  /// The row at a position of the blocks' order.
  Index row(Index position) const { return order_[static_cast<std::size_t>(position)]; }
  /// The rows from a position on.
  const Index* order(Index position) const { return order_.data() + position; }
  /// The cells around a block.
  std::span<const Index> cells(Index block) const { return part(cells_, block); }
  /// Where the sum of each cell is added. The block's own matrix holds one unused entry, then the
  /// rows in the order of positions, each as in the pattern.
  std::span<const distortion::SimplexPlaces<D>> places(Index block) const {
    return part(places_, block);
  }
  /// Entries of a block's own matrix.
  Index entries(Index block) const { return entries_[static_cast<std::size_t>(block)]; }

  /// First cell number of a block that is in no earlier block, after renumber_cells().
  Index first_new_cell(Index block) const { return first_new_[static_cast<std::size_t>(block)]; }

  /// Bytes, with the pattern.
  std::size_t bytes() const {
    return bytes_of(pattern_) +
           bytes_of(order_, cell_offsets_, cells_, places_, entries_, first_new_);
  }

  /// Renumbers the cells in the order in which the blocks use them. Returns the old number of each.
  std::vector<Index> renumber_cells();

 private:
  template <typename T>
  std::span<const T> part(const std::vector<T>& all, Index block) const {
    const auto b = static_cast<std::size_t>(block);
    const auto first = static_cast<std::size_t>(cell_offsets_[b]);
    return {all.data() + first, static_cast<std::size_t>(cell_offsets_[b + 1]) - first};
  }

  std::shared_ptr<const SparsityPattern> pattern_;
  std::vector<Index> order_;
  std::vector<Index> cell_offsets_{0};
  std::vector<Index> cells_;
  std::vector<distortion::SimplexPlaces<D>> places_;
  std::vector<Index> entries_;
  std::vector<Index> first_new_;
};

class GradientParts;

/// Rows of the nodes with unknowns, then those of images, then those of nodes that follow; -1 for
/// all others.
inline std::vector<Index> make_row_of_node(const NodeUnknowns& nodes) {
  std::vector<Index> row(at(nodes.topology().node_count()), -1);
  Index next = 0;
  for (const Index node : nodes.nodes()) row[at(node)] = next++;
  for (const auto& image : nodes.images()) row[at(image.image)] = next++;
  for (const auto& of : nodes.rows())
    for (const Index node : of->between()) row[at(node)] = next++;
  return row;
}

/// Number of all rows, including those of nodes without their own unknowns.
inline Index count_rows(const NodeUnknowns& nodes) {
  std::size_t count = nodes.nodes().size() + nodes.images().size();
  for (const auto& of : nodes.rows()) count += of->between().size();
  return static_cast<Index>(count);
}

/// Data that depend only on the connectivity and the moving nodes.
template <int D>
struct SimplexStructure {
  SimplexStructure(const NodeUnknowns& nodes, const CellTargets<D>& shapes)
      : row_of_node(make_row_of_node(nodes)),
        rows(shapes.cells, row_of_node, count_rows(nodes), nodes.threads()),
        shape_order(rows.renumber_cells()),
        cells_at_row(at(count_rows(nodes)), 0),
        followers(nodes, row_of_node, rows.pattern()),
        periodic(nodes, followers.pattern()),
        sliding(nodes, *periodic.pattern()) {
    for (std::size_t t = 0; t < shape_order.size(); ++t) {
      bool all_free = true;
      for (const Index node : shapes.cells[at(shape_order[t])]) {
        const Index row = row_of_node[at(node)];
        all_free &= row >= 0;
        if (row >= 0) ++cells_at_row[at(row)];
      }
      if (!all_free) half_free.push_back(static_cast<Index>(t));
    }
  }
  std::vector<Index> row_of_node;
  RowBlocks<D> rows;
  std::vector<Index> shape_order;   // for each cell of shapes_, its number in the targets as given
  std::vector<Index> half_free;     // cells with a node that has no unknowns
  std::vector<Index> cells_at_row;  // how many
  FollowerRows<D> followers;
  PeriodicRows<D> periodic;
  SlidingRows<D> sliding;
  /// Made when a first-order method first needs them; in the plane there are none.
  struct Parts {
    std::once_flag once;
    std::shared_ptr<const GradientParts> made;
  };
  mutable Parts parts;

  /// Bytes, without those of `parts`.
  std::size_t bytes() const {
    const auto& reduced = periodic.pattern();
    return rows.bytes() + (reduced != rows.pattern() ? bytes_of(reduced) : 0) +
           bytes_of(row_of_node, shape_order, half_free, cells_at_row);
  }

  /// Whether some rows belong to nodes without their own unknowns.
  bool joins() const { return !followers.empty() || !periodic.empty(); }
  /// Whether the gradient of a row is combined with those of other rows.
  bool is_joint(std::size_t row) const {
    if (followers.is_part(row)) return true;
    return row < cells_at_row.size() - follower_count() && periodic.is_part(row);
  }
  /// The rows with unknowns to which a row contributes; -1 for none.
  std::array<Index, 2> unknown_rows(std::size_t row) const {
    std::array<Index, 2> out = followers.rows(row);
    for (Index& r : out)
      if (r >= 0) r = periodic.row(at(r));
    if (out[0] == out[1]) out[1] = -1;
    return out;
  }
  /// The foot of a row in the result of SlidingRows::feet(); null if the row does not slide.
  const Foot* foot(std::span<const Foot> feet, std::size_t row) const {
    const Index slot = sliding.slot(row);
    return slot < 0 ? nullptr : &feet[at(slot)];
  }

 private:
  std::size_t follower_count() const {
    return cells_at_row.size() - static_cast<std::size_t>(followers.pattern()->rows());
  }
};

/// Reduces sums over all rows, assembled as if all nodes moved independently, to the rows with
/// unknowns: eliminates followers, then images, then restricts sliding nodes.
template <int D>
class RowReduction {
 public:
  /// stuck: sliding nodes to hold (#nodes with unknowns, or empty).
  RowReduction(const SimplexStructure<D>& structure, const NodeUnknowns& nodes,
               const Coordinates& x, const std::vector<bool>& stuck)
      : structure_(structure),
        levers_(structure.followers.levers(nodes, x)),
        feet_(structure.sliding.feet(nodes, x)) {
    for (std::size_t row = 0; row < stuck.size(); ++row)
      if (stuck[row]) feet_[at(structure.sliding.slot(row))].frame = {};
    if (!structure.joins()) return;
    scales_.resize(structure.cells_at_row.size());
    full_.resize(D * scales_.size());
  }

  /// Storage for all rows: `out` (which may be empty) if all rows have their own unknowns.
  std::span<double> all_rows(std::span<double> out) {
    return structure_.joins() ? std::span<double>(full_) : out;
  }
  /// Adds a row's scaled gradient to the norms; for a joint row stores its scale for reduce().
  void add_norm(std::size_t row, const RowSum<D>& sum, NormSum& norms) {
    const Index count = structure_.cells_at_row[row];
    if (structure_.is_joint(row))
      scales_[row] = sum.scale_of(count);
    else
      norms.add(sum.scaled(count, structure_.foot(feet_, row)));
  }
  /// full: all_rows(); may be empty if `out` is. norms: null, or receives those of joint rows.
  void reduce(std::span<double> full, std::span<double> out, std::vector<NormSum>* norms) const {
    if (!structure_.joins()) {
      if (!out.empty()) structure_.sliding.restrict(feet_, out);
      return;
    }
    std::vector<double> reduced = joined(full);
    structure_.sliding.restrict(feet_, reduced);
    if (norms) norms->push_back(joint_norms(reduced));
    if (!out.empty()) std::ranges::copy(reduced, out.begin());
  }
  /// matrix: over all rows; `out` itself if all rows have their own unknowns. full: all_rows()
  /// before the reduction.
  void reduce(std::span<const double> full, bool convex, SparseMatrix& matrix,
              SparseMatrix& out) const {
    const auto& [followers, periodic, sliding] =
        std::tie(structure_.followers, structure_.periodic, structure_.sliding);
    if (!structure_.joins()) {
      sliding.restrict(feet_, full, convex, out);
      return;
    }
    SparseMatrix without;  // followers
    SparseMatrix& middle = followers.empty() ? matrix : periodic.empty() ? out : without;
    if (!followers.empty()) followers.reduce(levers_, full, convex, matrix, middle);
    if (!periodic.empty()) periodic.reduce(middle, out);
    sliding.restrict(feet_, joined(full), convex, out);
  }

 private:
  using Scale = typename RowSum<D>::Scale;

  std::vector<double> joined(std::span<const double> full) const {
    std::vector<double> middle(full.begin(), full.end());
    if (!structure_.followers.empty()) {
      middle.resize(D * at(structure_.followers.pattern()->rows()));
      structure_.followers.reduce(levers_, full, middle);
    }
    std::vector<double> out(D * at(structure_.periodic.pattern()->rows()));
    structure_.periodic.reduce(middle, out);
    return out;
  }

  NormSum joint_norms(std::span<const double> reduced) const {
    std::vector<Scale> own(reduced.size() / D);
    std::vector<unsigned char> joint(own.size(), 0);
    for (std::size_t row = 0; row < scales_.size(); ++row) {
      if (!structure_.is_joint(row)) continue;
      for (const Index r : structure_.unknown_rows(row)) {
        if (r < 0) continue;
        joint[at(r)] = 1;
        own[at(r)].trace += scales_[row].trace;
        own[at(r)].edges += scales_[row].edges;
        own[at(r)].cells += scales_[row].cells;
      }
    }
    NormSum sum;
    for (std::size_t i = 0; i < own.size(); ++i)
      if (joint[i] != 0)
        sum.add(own[i].scaled(Eigen::Map<const Vec<D>>(reduced.data() + D * i).norm()));
    return sum;
  }

  const SimplexStructure<D>& structure_;
  std::vector<typename FollowerRows<D>::Lever> levers_;
  std::vector<Foot> feet_;
  std::vector<Scale> scales_;
  std::vector<double> full_;
};

}  // namespace winslow
