#include "core/formulation/variational_winslow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/formulation/distortion.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

using distortion::Corner2;
using distortion::PenaltyFunction;
using distortion::TriangleData;
using distortion::TriangleSum;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::size_t block_count(Index n) { return at((n + parallel_block - 1) / parallel_block); }

double larger(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

/// Sums of what blocks of rows came to, in the order of the blocks.
struct NormSum {
  double max = 0, squares = 0;
  Index count = 0;

  void add(double scaled) {
    max = larger(max, scaled);
    squares += scaled * scaled;
    ++count;
  }
  static ResidualNorms total(const std::vector<NormSum>& parts) {
    NormSum sum;
    for (const NormSum& part : parts) {
      sum.max = larger(sum.max, part.max);
      sum.squares += part.squares;
      sum.count += part.count;
    }
    return {sum.max, sum.count > 0 ? std::sqrt(sum.squares / sum.count) : 0};
  }
};

std::vector<Index> make_row_of_node(const Topology& topology) {
  std::vector<Index> row(at(topology.node_count()), -1);
  const auto free = topology.free_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) row[at(free[i])] = static_cast<Index>(i);
  return row;
}

/// Targets in the order of `old_number`.
TargetShapes reordered(const TargetShapes& shapes, const std::vector<Index>& old_number) {
  TargetShapes out;
  out.triangles.reserve(old_number.size());
  out.terms.reserve(shapes.terms.size());
  for (const Index t : old_number) {
    out.triangles.push_back(shapes.triangles[at(t)]);
    out.terms.insert(out.terms.end(), shapes.terms.begin() + shapes.offsets[at(t)],
                     shapes.terms.begin() + shapes.offsets[at(t) + 1]);
    out.offsets.push_back(static_cast<Index>(out.terms.size()));
  }
  return out;
}

/// What the triangles around one row came to: diagonal block, gradient, length of their edges at
/// the node, number.
struct RowSum {
  static constexpr std::size_t size = 8;
  const double* v;

  double gx() const { return v[4]; }
  double gy() const { return v[5]; }
  /// Distance by which the node alone would move, over the mean edge.
  double scaled() const {
    const double mean_edge = v[6] / (2 * std::max(v[7], 1.0));
    const double scale = 0.5 * (v[0] + v[3]) * mean_edge;
    const double g = std::sqrt(gx() * gx() + gy() * gy());
    return scale > 0 ? g / scale : g;
  }
};

}  // namespace

/// One block of rows as it is summed up.
struct VariationalWinslow::BlockMemory {
  static constexpr std::size_t chunk = 64;  // triangles whose sums stay in the first-level cache
  static constexpr std::size_t row_count = at(RowBlocks::rows_per_block) + 1;

  std::vector<double> sums = std::vector<double>(chunk * TriangleSum::size);
  std::vector<double> rows = std::vector<double>(row_count * RowSum::size);
  std::vector<double> matrix;  // entries of the block by 4

  RowSum row(Index i) const { return {rows.data() + RowSum::size * at(i)}; }
};

VariationalWinslow::VariationalWinslow(std::shared_ptr<const Topology> topology,
                                       const TargetShapes& shapes, const PenaltyOptions& penalty,
                                       int threads)
    : topology_(std::move(topology)),
      penalty_(penalty),
      threads_(threads),
      row_of_node_(make_row_of_node(*topology_)),
      rows_(shapes.triangles, row_of_node_, static_cast<Index>(topology_->free_nodes().size())),
      shape_order_(rows_.renumber_triangles()) {
  set_shapes(shapes);
  for (std::size_t t = 0; t < shapes_.triangles.size(); ++t) {
    const auto& nodes = shapes_.triangles[t];
    if (std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return row_of_node_[at(n)] < 0; })) {
      half_free_.push_back(static_cast<Index>(t));
    }
  }
}

void VariationalWinslow::set_shapes(const TargetShapes& shapes) {
  shapes_ = reordered(shapes, shape_order_);
}

TriangleData VariationalWinslow::data(const Coordinates& x,
                                      const Regularisation* regularisation) const {
  static_assert(sizeof(ShapeTerm) == 4 * sizeof(double));
  static_assert(sizeof(shapes_.triangles[0]) == 3 * sizeof(Index));
  TriangleData data;
  data.x = x.values().data();
  data.nodes = shapes_.triangles.empty() ? nullptr : shapes_.triangles.front().data();
  data.offsets = shapes_.offsets.data();
  data.terms = shapes_.terms.empty() ? nullptr : &shapes_.terms.front().ab;
  data.penalty = PenaltyFunction(penalty_.exponent, penalty_.knee).constants();
  if (regularisation) {
    data.size = regularisation->size.data();
    data.epsilon = regularisation->epsilon;
    data.curvature_share = 0;
  }
  return data;
}

/// visit(part, block, first and last position of the block's rows, memory to work in), blocks in
/// parallel; a part is what one sum of norms covers.
template <typename Visit>
void VariationalWinslow::for_each_block(Visit&& visit) const {
  static_assert(parallel_block % RowBlocks::rows_per_block == 0);
  parallel_for(threads_, rows_.rows(), [&](Index begin, Index end) {
    BlockMemory memory;
    for (Index first = begin; first < end; first += RowBlocks::rows_per_block) {
      visit(at(begin / parallel_block), first / RowBlocks::rows_per_block, first,
            std::min(end, first + RowBlocks::rows_per_block), memory);
    }
  });
}

void VariationalWinslow::add_projected(const TriangleData& data, std::span<const Index> triangles,
                                       double* sums) const {
  const PenaltyFunction psi(penalty_.exponent, penalty_.knee);
  for (const Index t : triangles) {
    std::fill(sums, sums + TriangleSum::corners, 0.0);
    const auto& nodes = shapes_.triangles[at(t)];
    const auto point = [&](Index node) { return data.x + 2 * static_cast<std::ptrdiff_t>(node); };
    const Corner2 q(point(nodes[0]), point(nodes[1]), point(nodes[2]));
    for (Index k = shapes_.offsets[at(t)]; k < shapes_.offsets[at(t) + 1]; ++k) {
      distortion::add_projected_blocks(q, shapes_.terms[at(k)], psi, sums);
    }
    sums += TriangleSum::size;
  }
}

/// The sums of a block's rows and, with_matrix, its part of the Hessian. Returns the energy of the
/// triangles that no earlier block has.
double VariationalWinslow::sum_block(const TriangleData& data, bool project, bool with_matrix,
                                     Index block, BlockMemory& memory) const {
  std::fill(memory.rows.begin(), memory.rows.end(), 0.0);
  if (with_matrix) memory.matrix.assign(4 * at(rows_.entries(block)), 0.0);
  const auto triangles = rows_.triangles(block);
  const auto places = rows_.places(block);
  double energy = 0;
  for (std::size_t first = 0; first < triangles.size(); first += BlockMemory::chunk) {
    const auto part =
        triangles.subspan(first, std::min(BlockMemory::chunk, triangles.size() - first));
    const auto count = static_cast<Index>(part.size());
    energy +=
        kernel_.sum(data, part.data(), count, rows_.first_new_triangle(block), memory.sums.data());
    if (project) add_projected(data, part, memory.sums.data());
    kernel_.scatter(memory.sums.data(), places.data() + first, count, memory.rows.data(),
                    with_matrix ? memory.matrix.data() : nullptr);
  }
  return energy;
}

double VariationalWinslow::energy(const Coordinates& x,
                                  const Regularisation* regularisation) const {
  const TriangleData triangles = data(x, regularisation);
  const auto n = static_cast<Index>(shapes_.triangles.size());
  std::vector<double> sums(block_count(n), 0.0);
  parallel_for(threads_, n, [&](Index begin, Index end) {
    sums[at(begin / parallel_block)] = kernel_.energy(triangles, begin, end);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double VariationalWinslow::worst_distortion(const Coordinates& x) const {
  double worst = 0;
  for (std::size_t t = 0; t < shapes_.triangles.size(); ++t) {
    const auto& nodes = shapes_.triangles[t];
    const Corner2 q(x.point(nodes[0]), x.point(nodes[1]), x.point(nodes[2]));
    if (!(q.d > 0)) return std::numeric_limits<double>::infinity();
    for (Index k = shapes_.offsets[t]; k < shapes_.offsets[t + 1]; ++k) {
      worst = std::max(worst, q.distortion(shapes_.terms[at(k)]));
    }
  }
  return worst;
}

ResidualNorms VariationalWinslow::residual(const Coordinates& x, bool,
                                           std::span<double> out) const {
  const TriangleData triangles = data(x, nullptr);
  std::vector<NormSum> norms(block_count(rows_.rows()));
  for_each_block([&](std::size_t part, Index block, Index first, Index last, BlockMemory& memory) {
    sum_block(triangles, false, false, block, memory);
    for (Index p = first; p < last; ++p) {
      const RowSum sum = memory.row(p - first);
      norms[part].add(sum.scaled());
      if (out.empty()) continue;
      out[2 * at(rows_.row(p))] = -sum.gx();
      out[2 * at(rows_.row(p)) + 1] = -sum.gy();
    }
  });
  return NormSum::total(norms);
}

Linearisation VariationalWinslow::linearise(const Coordinates& x, Curvature curvature,
                                            SparseMatrix& out, std::span<double> residual,
                                            const Regularisation* regularisation) const {
  const SparsityPattern& pattern = *rows_.pattern();
  out.pattern = rows_.pattern();
  out.block = 2;
  out.symmetric = true;
  out.values.resize(4 * pattern.columns.size());
  std::vector<NormSum> norms(block_count(rows_.rows()));
  std::vector<double> energies(norms.size(), 0.0);
  const TriangleData triangles = data(x, regularisation);
  const bool project = curvature == Curvature::projected && !regularisation;
  for_each_block([&](std::size_t part, Index block, Index first, Index last, BlockMemory& memory) {
    energies[part] += sum_block(triangles, project, true, block, memory);
    kernel_.write_rows(memory.matrix.data() + 4, rows_.order(first), pattern.offsets.data(),
                       last - first, out.values.data());
    for (Index p = first; p < last; ++p) {
      const std::size_t row = at(rows_.row(p));
      const RowSum sum = memory.row(p - first);
      // Its parts are rounded apart: make the diagonal symmetric.
      const double off_diagonal = 0.5 * (sum.v[1] + sum.v[2]);
      double* diagonal = out.values.data() + 4 * static_cast<std::ptrdiff_t>(pattern.diagonal[row]);
      diagonal[0] = sum.v[0];
      diagonal[1] = diagonal[2] = off_diagonal;
      diagonal[3] = sum.v[3];
      norms[part].add(sum.scaled());
      residual[2 * row] = -sum.gx();
      residual[2 * row + 1] = -sum.gy();
    }
  });
  return {NormSum::total(norms), std::accumulate(energies.begin(), energies.end(), 0.0)};
}

void VariationalWinslow::boundary_response(const Coordinates& x, const Coordinates& displacement,
                                           std::span<double> out) const {
  const TriangleData triangles = data(x, nullptr);
  std::vector<double> sums((half_free_.size() + 3) / 4 * 4 * TriangleSum::size);
  kernel_.sum(triangles, half_free_.data(), static_cast<Index>(half_free_.size()), 0, sums.data());
  std::fill(out.begin(), out.end(), 0.0);
  // out_i -= H_ij m_j for free i and constrained j.
  const auto subtract = [&](Index i, Index j, const double* h, bool is_transposed) {
    const Index row = row_of_node_[at(i)];
    if (row < 0 || row_of_node_[at(j)] >= 0) return;
    const double* m = displacement.point(j);
    out[2 * at(row)] -= h[0] * m[0] + h[is_transposed ? 2 : 1] * m[1];
    out[2 * at(row) + 1] -= h[is_transposed ? 1 : 2] * m[0] + h[3] * m[1];
  };
  const double* sum = sums.data();
  for (const Index t : half_free_) {
    const auto& [a, b, c] = shapes_.triangles[at(t)];
    const auto both = [&](Index i, Index j, std::ptrdiff_t place) {
      subtract(i, j, sum + place, false);
      subtract(j, i, sum + place, true);
    };
    both(a, b, TriangleSum::ab);
    both(a, c, TriangleSum::ac);
    both(b, c, TriangleSum::bc);
    sum += TriangleSum::size;
  }
}

}  // namespace winslow
