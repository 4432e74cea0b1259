#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/formulation/cell_targets.h"
#include "core/formulation/periodic_rows.h"
#include "core/formulation/row_blocks.h"
#include "core/formulation/row_sums.h"
#include "core/formulation/sliding_rows.h"
#include "core/problem/node_unknowns.h"

namespace winslow {

/// Rows of the nodes with unknowns, then those of images; -1 for all others.
inline std::vector<Index> make_row_of_node(const NodeUnknowns& nodes) {
  std::vector<Index> row(at(nodes.topology().node_count()), -1);
  Index next = 0;
  for (const Index node : nodes.nodes()) row[at(node)] = next++;
  for (const auto& image : nodes.images()) row[at(image.image)] = next++;
  return row;
}

/// What depends on the connectivity alone, and on which nodes move.
template <int D>
struct SimplexStructure {
  SimplexStructure(const NodeUnknowns& nodes, const CellTargets<D>& shapes)
      : row_of_node(make_row_of_node(nodes)),
        rows(shapes.cells, row_of_node,
             static_cast<Index>(nodes.nodes().size() + nodes.images().size()), nodes.threads()),
        shape_order(rows.renumber_cells()),
        cells_at_row(nodes.nodes().size() + nodes.images().size(), 0),
        sliding(nodes, *rows.pattern()),
        periodic(nodes, rows.pattern()) {
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
  std::vector<Index> shape_order;   // number in the targets as given of each cell of shapes_
  std::vector<Index> half_free;     // cells with a node that has no unknowns
  std::vector<Index> cells_at_row;  // how many
  SlidingRows<D> sliding;
  PeriodicRows<D> periodic;
  using Scale = typename RowSum<D>::Scale;
  /// Of the rows of periodic pairs, which have one gradient together. scales: #all rows; residual:
  /// reduced.
  NormSum norms_of_pairs(const std::vector<Scale>& scales, std::span<const double> residual) const {
    std::vector<Scale> own(residual.size() / D);
    for (std::size_t row = 0; row < scales.size(); ++row) {
      if (!periodic.is_part(row)) continue;
      Scale& of = own[at(periodic.row(row))];
      of.trace += scales[row].trace;
      of.edges += scales[row].edges;
      of.cells += scales[row].cells;
    }
    NormSum sum;
    for (std::size_t i = 0; i < own.size(); ++i)
      if (periodic.is_part(i))
        sum.add(own[i].scaled(Eigen::Map<const Vec<D>>(residual.data() + D * i).norm()));
    return sum;
  }
  /// Of a row, by what SlidingRows::feet() gives.
  const Foot* foot(std::span<const Foot> feet, std::size_t row) const {
    const Index slot = sliding.slot(row);
    return slot < 0 ? nullptr : &feet[at(slot)];
  }
};

/// What is summed up over all rows, those of images too, where there are such; else nothing.
template <int D>
class PairedRows {
 public:
  explicit PairedRows(const SimplexStructure<D>& structure) : structure_(structure) {
    if (structure.periodic.empty()) return;
    scales.resize(structure.cells_at_row.size());
    full_.resize(D * scales.size());
  }
  /// Of all rows: `out` where there are no images.
  std::span<double> residual(std::span<double> out) {
    return structure_.periodic.empty() ? out : std::span<double>(full_);
  }
  /// To the rows with unknowns. out: may be empty; adds the norms of pairs.
  void reduce(std::span<const double> full, std::span<double> out, std::vector<NormSum>& norms) {
    if (structure_.periodic.empty()) return;
    const std::size_t images =
        static_cast<std::size_t>(std::ranges::count_if(structure_.row_of_node, [&](Index row) {
          return row >= 0 && structure_.periodic.row(at(row)) != row;
        }));
    std::vector<double> reduced(full.size() - D * images);
    structure_.periodic.reduce(full, reduced);
    norms.push_back(structure_.norms_of_pairs(scales, reduced));
    if (!out.empty()) std::ranges::copy(reduced, out.begin());
  }

  std::vector<typename SimplexStructure<D>::Scale> scales;

 private:
  const SimplexStructure<D>& structure_;
  std::vector<double> full_;
};

}  // namespace winslow
