#include "core/formulation/variational_winslow.h"

#include "core/formulation/distortion.h"
#include "core/formulation/row_blocks.h"
#include "core/formulation/row_elimination.h"
#include "core/formulation/target_metric.h"
#include "core/formulation/target_path.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

using distortion::PenaltyFunction;
using distortion::SimplexData;
template <int D>
using Layout = distortion::SimplexLayout<D>;

std::size_t block_count(Index n) { return at((n + parallel_block - 1) / parallel_block); }

/// Targets in the order of `old_number`.
template <int D>
CellTargets<D> reordered(const CellTargets<D>& shapes, const std::vector<Index>& old_number) {
  CellTargets<D> out;
  out.stretched = shapes.stretched;
  out.cells.reserve(old_number.size());
  out.terms.reserve(shapes.terms.size());
  for (const Index t : old_number) {
    out.cells.push_back(shapes.cells[at(t)]);
    out.terms.insert(out.terms.end(), shapes.terms.begin() + shapes.offsets[at(t)],
                     shapes.terms.begin() + shapes.offsets[at(t) + 1]);
    out.offsets.push_back(static_cast<Index>(out.terms.size()));
  }
  return out;
}

double distortion_of(const std::array<Vec2, 3>& p, const ShapeTerm& term) {
  return distortion::Corner2(p[0].data(), p[1].data(), p[2].data()).distortion(term);
}
double distortion_of(const std::array<Vec3, 4>& p, const VolumeTerm& term) {
  return distortion::Corner3(p).distortion(term);
}

}  // namespace

/// One block of rows as it is summed up.
template <int D>
struct SimplexWinslow<D>::BlockMemory {
  static constexpr std::size_t chunk = 64;  // cells whose sums stay in the fast caches
  static constexpr std::size_t row_count = at(RowBlocks<D>::rows_per_block) + 1;
  std::vector<double> sums = std::vector<double>(chunk * Layout<D>::sum);
  std::vector<double> rows = std::vector<double>(row_count * Layout<D>::row);
  std::vector<double> matrix;  // entries of the block

  RowSum<D> row(Index i) const { return {rows.data() + Layout<D>::row * i}; }
};

template <int D>
SimplexWinslow<D>::Pattern::Pattern(std::shared_ptr<const NodeClasses> classes,
                                    const Targets& targets, int threads)
    : nodes(std::move(classes), threads, NodeUnknowns::Layout::blocks),
      structure(std::make_shared<const SimplexStructure<D>>(nodes, targets)) {}

template <int D>
SimplexWinslow<D>::SimplexWinslow(const Pattern& pattern, const Targets& shapes,
                                  const PenaltyOptions& penalty)
    : VariationalForm(pattern.nodes, penalty),
      structure_(pattern.structure),
      shapes_(std::make_shared<const Targets>(reordered(shapes, structure_->shape_order))) {
  node_unknowns().require_held_boundary("the variational form");
}

template <int D>
std::shared_ptr<const VariationalForm> SimplexWinslow<D>::with_penalty(
    const PenaltyOptions& penalty) const {
  auto other = std::make_shared<SimplexWinslow>(*this);
  other->set_penalty(penalty);
  return other;
}

template <int D>
std::shared_ptr<const SimplexWinslow<D>> SimplexWinslow<D>::with_ordered_shapes(
    std::shared_ptr<const Targets> shapes) const {
  auto other = std::make_shared<SimplexWinslow>(*this);
  other->shapes_ = std::move(shapes);
  return other;
}

template <int D>
std::unique_ptr<const TargetPath> SimplexWinslow<D>::target_path(const Coordinates& from) const {
  return std::make_unique<ShapePath<D>>(std::make_shared<const SimplexWinslow>(*this), from,
                                        threads());
}

template <int D>
SimplexData SimplexWinslow<D>::data(const Coordinates& x,
                                    const Regularisation* regularisation) const {
  static_assert(sizeof(typename Targets::Term) == Layout<D>::term * sizeof(double));
  x.require_dimension(D);
  const Targets& shapes = *shapes_;
  static_assert(sizeof(shapes.cells[0]) == (D + 1) * sizeof(Index));
  SimplexData data;
  data.x = x.values().data();
  data.nodes = shapes.cells.empty() ? nullptr : shapes.cells.front().data();
  data.offsets = shapes.offsets.data();
  // The first member of the first term: a term is nothing but numbers.
  data.terms = reinterpret_cast<const double*>(shapes.terms.data());
  data.penalty = PenaltyFunction(penalty()).constants();
  if (regularisation) {
    data.size = regularisation->size.data();
    data.epsilon = 1;
    data.curvature_share = 0;
  }
  return data;
}

/// visit(part, block, first and last position of the block's rows, memory to work in), blocks in
/// parallel; a part is what one sum of norms covers.
template <int D>
template <typename Visit>
void SimplexWinslow<D>::for_each_block(Visit&& visit) const {
  constexpr Index rows_per_block = RowBlocks<D>::rows_per_block;
  static_assert(parallel_block % rows_per_block == 0);
  parallel_for(threads(), structure_->rows.rows(), [&](Index begin, Index end) {
    BlockMemory memory;
    for (Index first = begin; first < end; first += rows_per_block) {
      visit(at(begin / parallel_block), first / rows_per_block, first,
            std::min(end, first + rows_per_block), memory);
    }
  });
}

namespace {

template <int D>
std::array<Vec<D>, D + 1> points_of(const double* x, const std::array<Index, D + 1>& nodes) {
  std::array<Vec<D>, D + 1> points;
  for (std::size_t k = 0; k <= D; ++k)
    points[k] = Vec<D>(x + D * static_cast<std::ptrdiff_t>(nodes[k]));
  return points;
}

}  // namespace

/// Projects the Hessians of the cells, which are otherwise summed up.
template <>
void SimplexWinslow<2>::project(const SimplexData& data, std::span<const Index> cells,
                                double* sums) const {
  const PenaltyFunction psi(penalty());
  const Targets& shapes = *shapes_;
  for (const Index t : cells) {
    std::fill(sums, sums + Layout<2>::corners, 0.0);
    const auto p = points_of<2>(data.x, shapes.cells[at(t)]);
    const distortion::Corner2 corner(p[0].data(), p[1].data(), p[2].data());
    for (Index k = shapes.offsets[at(t)]; k < shapes.offsets[at(t) + 1]; ++k)
      distortion::add_projected_blocks(corner, shapes.terms[at(k)], psi, sums);
    sums += Layout<2>::sum;
  }
}

/// The sums of a block's rows and, with_matrix, its part of the Hessian. Returns the energy of the
/// cells that no earlier block has, with the matrix only.
template <int D>
double SimplexWinslow<D>::sum_block(const SimplexData& data, bool is_projected, bool with_matrix,
                                    Index block, BlockMemory& memory) const {
  const RowBlocks<D>& rows = structure_->rows;
  std::fill(memory.rows.begin(), memory.rows.end(), 0.0);
  if (with_matrix) memory.matrix.assign(D * D * at(rows.entries(block)), 0.0);
  const auto cells = rows.cells(block);
  const auto places = rows.places(block);
  double energy = 0;
  for (std::size_t first = 0; first < cells.size(); first += BlockMemory::chunk) {
    const auto part = cells.subspan(first, std::min(BlockMemory::chunk, cells.size() - first));
    const auto count = static_cast<Index>(part.size());
    if (!with_matrix && kernel_.sum_gradients) {
      kernel_.sum_gradients(data, part.data(), count, memory.sums.data());
      kernel_.scatter_gradients(memory.sums.data(), places.data() + first, count,
                                memory.rows.data());
      continue;
    }
    const auto sum = is_projected && kernel_.sum_projected ? kernel_.sum_projected : kernel_.sum;
    energy += sum(data, part.data(), count, rows.first_new_cell(block), memory.sums.data());
    if constexpr (D == 2) {
      if (is_projected) project(data, part, memory.sums.data());
    }
    kernel_.scatter(memory.sums.data(), places.data() + first, count, memory.rows.data(),
                    with_matrix ? memory.matrix.data() : nullptr);
  }
  return energy;
}

template <int D>
double SimplexWinslow<D>::energy_of(const SimplexData& cells) const {
  const auto n = static_cast<Index>(shapes_->cells.size());
  std::vector<double> sums(block_count(n), 0.0);
  parallel_for(threads(), n, [&](Index begin, Index end) {
    sums[at(begin / parallel_block)] = kernel_.energy(cells, begin, end);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

template <int D>
double SimplexWinslow<D>::energy(const Coordinates& x) const {
  return energy_of(data(x, nullptr));
}

template <int D>
double SimplexWinslow<D>::regularised_energy(const Coordinates& x,
                                             const Regularisation& regularisation) const {
  return energy_of(data(x, &regularisation));
}

template <int D>
std::shared_ptr<const VariationalForm> SimplexWinslow<D>::with_corner_lengths(
    const Coordinates& x) const {
  x.require_dimension(D);
  return with_ordered_shapes(
      std::make_shared<const Targets>(winslow::with_corner_lengths(*shapes_, x)));
}

template <int D>
double SimplexWinslow<D>::worst_distortion(const Coordinates& x) const {
  const Targets& shapes = *shapes_;
  x.require_dimension(D);
  double worst = 0;
  for (std::size_t t = 0; t < shapes.cells.size(); ++t) {
    const auto points = points_of<D>(x.values().data(), shapes.cells[t]);
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      const double f = distortion_of(points, shapes.terms[at(k)]);
      if (!(f > 0)) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, f);
    }
  }
  return worst;
}

template <int D>
ResidualNorms SimplexWinslow<D>::residual(const Coordinates& x, std::span<double> out) const {
  const SimplexData cells = data(x, nullptr);
  const RowBlocks<D>& rows = structure_->rows;
  std::vector<NormSum> norms(block_count(rows.rows()));
  RowReduction<D> reduction(*structure_, node_unknowns(), x, stuck_);
  const std::span<double> full = reduction.all_rows(out);
  for_each_block([&](std::size_t part, Index block, Index first, Index last, BlockMemory& memory) {
    sum_block(cells, false, false, block, memory);
    for (Index p = first; p < last; ++p) {
      const RowSum<D> sum = memory.row(p - first);
      const std::size_t row = at(rows.row(p));
      reduction.add_norm(row, sum, norms[part]);
      if (full.empty()) continue;
      for (std::size_t k = 0; k < D; ++k) full[D * row + k] = -sum.gradient()[k];
    }
  });
  reduction.reduce(full, out, &norms);
  return NormSum::total(norms);
}

template <int D>
Linearisation SimplexWinslow<D>::linearise(const Coordinates& x, Curvature curvature,
                                           SparseMatrix& hessian,
                                           std::span<double> residual) const {
  return assemble(data(x, nullptr), x, curvature == Curvature::projected, false, hessian, residual);
}

template <int D>
Linearisation SimplexWinslow<D>::linearise_regularised(const Coordinates& x,
                                                       const Regularisation& regularisation,
                                                       SparseMatrix& hessian,
                                                       std::span<double> residual) const {
  return assemble(data(x, &regularisation), x, false, true, hessian, residual);
}

template <int D>
Linearisation SimplexWinslow<D>::assemble(const SimplexData& cells, const Coordinates& x,
                                          bool project, bool convex, SparseMatrix& hessian,
                                          std::span<double> residual) const {
  const RowBlocks<D>& rows = structure_->rows;
  const SparsityPattern& pattern = *rows.pattern();
  RowReduction<D> reduction(*structure_, node_unknowns(), x, stuck_);
  const std::span<double> full = reduction.all_rows(residual);
  SparseMatrix unreduced;
  SparseMatrix& out = structure_->joins() ? unreduced : hessian;
  out.pattern = rows.pattern();
  out.block = D;
  out.symmetric = true;
  constexpr std::ptrdiff_t block_size = std::ptrdiff_t{D} * D;
  out.values.resize(static_cast<std::size_t>(block_size) * pattern.columns.size());
  std::vector<NormSum> norms(block_count(rows.rows()));
  std::vector<double> energies(norms.size(), 0.0);
  for_each_block([&](std::size_t part, Index block, Index first, Index last, BlockMemory& memory) {
    energies[part] += sum_block(cells, project, true, block, memory);
    kernel_.write_rows(memory.matrix.data() + D * D, rows.order(first), pattern.offsets.data(),
                       last - first, out.values.data());
    for (Index p = first; p < last; ++p) {
      const std::size_t row = at(rows.row(p));
      const RowSum<D> sum = memory.row(p - first);
      double* diagonal =
          out.values.data() + block_size * static_cast<std::ptrdiff_t>(pattern.diagonal[row]);
      // Its parts are rounded apart: make the diagonal symmetric.
      for (int i = 0; i < D; ++i) {
        for (int j = 0; j < D; ++j)
          diagonal[D * i + j] =
              i == j ? sum.v[(D + 1) * i] : 0.5 * (sum.v[D * i + j] + sum.v[D * j + i]);
      }
      reduction.add_norm(row, sum, norms[part]);
      for (std::size_t k = 0; k < D; ++k) full[D * row + k] = -sum.gradient()[k];
    }
  });
  reduction.reduce(full, project || convex, out, hessian);
  reduction.reduce(full, residual, &norms);
  return {NormSum::total(norms), std::accumulate(energies.begin(), energies.end(), 0.0)};
}

template <int D>
void SimplexWinslow<D>::boundary_response(const Coordinates& x, const Coordinates& displacement,
                                          std::span<double> out) const {
  RowReduction<D> reduction(*structure_, node_unknowns(), x, stuck_);
  const std::span<double> full = reduction.all_rows(out);
  const SimplexData cells = data(x, nullptr);
  const std::vector<Index>& half_free = structure_->half_free;
  const std::vector<Index>& row_of_node = structure_->row_of_node;
  std::fill(full.begin(), full.end(), 0.0);
  const Points<D> moved(displacement);
  // out_i -= H_ij m_j for i with unknowns and j without.
  const auto subtract = [&](Index i, Index j, const double* h, bool is_transposed) {
    const Index row = row_of_node[at(i)];
    if (row < 0 || row_of_node[at(j)] >= 0) return;
    const Vec<D> m = moved[j];
    for (int r = 0; r < D; ++r) {
      double sum = 0;
      for (int c = 0; c < D; ++c) sum += h[is_transposed ? D * c + r : D * r + c] * m[c];
      full[D * at(row) + at(r)] -= sum;
    }
  };
  constexpr std::size_t chunk = 1024;
  constexpr std::ptrdiff_t block_size = std::ptrdiff_t{D} * D;
  std::vector<double> sums((chunk + 3) * Layout<D>::sum);
  for (std::size_t begin = 0; begin < half_free.size(); begin += chunk) {
    const std::size_t count = std::min(chunk, half_free.size() - begin);
    kernel_.sum(cells, half_free.data() + begin, static_cast<Index>(count), 0, sums.data());
    for (std::size_t i = 0; i < count; ++i) {
      const double* block = sums.data() + Layout<D>::sum * static_cast<std::ptrdiff_t>(i);
      const auto& nodes = shapes_->cells[at(half_free[begin + i])];
      for (std::size_t a = 0; a <= D; ++a) {
        for (std::size_t b = a + 1; b <= D; ++b, block += block_size) {
          subtract(nodes[a], nodes[b], block, false);
          subtract(nodes[b], nodes[a], block, true);
        }
      }
    }
  }
  reduction.reduce(full, out, nullptr);
}

template class SimplexWinslow<2>;
template class SimplexWinslow<3>;

}  // namespace winslow
