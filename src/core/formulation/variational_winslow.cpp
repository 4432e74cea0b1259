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

std::vector<Index> make_row_of_node(const NodeUnknowns& nodes) {
  std::vector<Index> row(at(nodes.topology().node_count()), -1);
  Index next = 0;
  for (const Index node : nodes.nodes()) row[at(node)] = next++;
  return row;
}

/// Targets in the order of `old_number`.
TargetShapes reordered(const TargetShapes& shapes, const std::vector<Index>& old_number) {
  TargetShapes out;
  out.stretched = shapes.stretched;
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

/// What depends on the connectivity alone.
struct VariationalWinslow::Structure {
  Structure(const NodeUnknowns& nodes, const TargetShapes& shapes)
      : row_of_node(make_row_of_node(nodes)),
        rows(shapes.triangles, row_of_node, static_cast<Index>(nodes.nodes().size())),
        shape_order(rows.renumber_triangles()) {
    for (std::size_t t = 0; t < shape_order.size(); ++t) {
      const auto& nodes = shapes.triangles[at(shape_order[t])];
      if (std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return row_of_node[at(n)] < 0; }))
        half_free.push_back(static_cast<Index>(t));
    }
  }

  std::vector<Index> row_of_node;
  RowBlocks rows;
  std::vector<Index> shape_order;  // number in TargetShapes::build of each triangle of shapes_
  std::vector<Index> half_free;    // triangles with a node that has no unknowns
};

VariationalWinslow::VariationalWinslow(std::shared_ptr<const NodeClasses> classes,
                                       const TargetShapes& shapes, const PenaltyOptions& penalty,
                                       int threads)
    : NodeProblem(NodeUnknowns(std::move(classes), threads)),
      structure_(std::make_shared<const Structure>(node_unknowns(), shapes)),
      shapes_(std::make_shared<const TargetShapes>(reordered(shapes, structure_->shape_order))),
      penalty_(penalty) {
  node_unknowns().require_free_interior("the variational form");
}

std::shared_ptr<const VariationalWinslow> VariationalWinslow::with_penalty(
    const PenaltyOptions& penalty) const {
  auto other = std::make_shared<VariationalWinslow>(*this);
  other->penalty_ = penalty;
  return other;
}

std::shared_ptr<const VariationalWinslow> VariationalWinslow::with_shapes(
    const TargetShapes& shapes) const {
  return with_ordered_shapes(
      std::make_shared<const TargetShapes>(reordered(shapes, structure_->shape_order)));
}

std::shared_ptr<const VariationalWinslow> VariationalWinslow::with_ordered_shapes(
    std::shared_ptr<const TargetShapes> shapes) const {
  auto other = std::make_shared<VariationalWinslow>(*this);
  other->shapes_ = std::move(shapes);
  return other;
}

TriangleData VariationalWinslow::data(const Coordinates& x,
                                      const Regularisation* regularisation) const {
  static_assert(sizeof(ShapeTerm) == 4 * sizeof(double));
  x.require_dimension(2);
  const TargetShapes& shapes = *shapes_;
  static_assert(sizeof(shapes.triangles[0]) == 3 * sizeof(Index));
  TriangleData data;
  data.x = x.values().data();
  data.nodes = shapes.triangles.empty() ? nullptr : shapes.triangles.front().data();
  data.offsets = shapes.offsets.data();
  data.terms = shapes.terms.empty() ? nullptr : &shapes.terms.front().ab;
  data.penalty = PenaltyFunction(penalty_.exponent, penalty_.knee).constants();
  if (regularisation) {
    data.size = regularisation->size.data();
    data.epsilon = 1;
    data.curvature_share = 0;
  }
  return data;
}

/// visit(part, block, first and last position of the block's rows, memory to work in), blocks in
/// parallel; a part is what one sum of norms covers.
template <typename Visit>
void VariationalWinslow::for_each_block(Visit&& visit) const {
  static_assert(parallel_block % RowBlocks::rows_per_block == 0);
  parallel_for(threads(), structure_->rows.rows(), [&](Index begin, Index end) {
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
  const TargetShapes& shapes = *shapes_;
  for (const Index t : triangles) {
    std::fill(sums, sums + TriangleSum::corners, 0.0);
    const auto& nodes = shapes.triangles[at(t)];
    const auto point = [&](Index node) { return data.x + 2 * static_cast<std::ptrdiff_t>(node); };
    const Corner2 q(point(nodes[0]), point(nodes[1]), point(nodes[2]));
    for (Index k = shapes.offsets[at(t)]; k < shapes.offsets[at(t) + 1]; ++k) {
      distortion::add_projected_blocks(q, shapes.terms[at(k)], psi, sums);
    }
    sums += TriangleSum::size;
  }
}

/// The sums of a block's rows and, with_matrix, its part of the Hessian. Returns the energy of the
/// triangles that no earlier block has.
double VariationalWinslow::sum_block(const TriangleData& data, bool project, bool with_matrix,
                                     Index block, BlockMemory& memory) const {
  const RowBlocks& rows = structure_->rows;
  std::fill(memory.rows.begin(), memory.rows.end(), 0.0);
  if (with_matrix) memory.matrix.assign(4 * at(rows.entries(block)), 0.0);
  const auto triangles = rows.triangles(block);
  const auto places = rows.places(block);
  double energy = 0;
  for (std::size_t first = 0; first < triangles.size(); first += BlockMemory::chunk) {
    const auto part =
        triangles.subspan(first, std::min(BlockMemory::chunk, triangles.size() - first));
    const auto count = static_cast<Index>(part.size());
    energy +=
        kernel_.sum(data, part.data(), count, rows.first_new_triangle(block), memory.sums.data());
    if (project) add_projected(data, part, memory.sums.data());
    kernel_.scatter(memory.sums.data(), places.data() + first, count, memory.rows.data(),
                    with_matrix ? memory.matrix.data() : nullptr);
  }
  return energy;
}

double VariationalWinslow::energy_of(const TriangleData& triangles) const {
  const auto n = static_cast<Index>(shapes_->triangles.size());
  std::vector<double> sums(block_count(n), 0.0);
  parallel_for(threads(), n, [&](Index begin, Index end) {
    sums[at(begin / parallel_block)] = kernel_.energy(triangles, begin, end);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

double VariationalWinslow::energy(const Coordinates& x) const {
  return energy_of(data(x, nullptr));
}

double VariationalWinslow::regularised_energy(const Coordinates& x,
                                              const Regularisation& regularisation) const {
  return energy_of(data(x, &regularisation));
}

double VariationalWinslow::worst_distortion(const Coordinates& x) const {
  const TargetShapes& shapes = *shapes_;
  const PlanePoints points(x);
  double worst = 0;
  for (std::size_t t = 0; t < shapes.triangles.size(); ++t) {
    const auto& nodes = shapes.triangles[t];
    const Vec2 a = points[nodes[0]], b = points[nodes[1]], c = points[nodes[2]];
    const Corner2 q(a.data(), b.data(), c.data());
    if (!(q.d > 0)) return std::numeric_limits<double>::infinity();
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      worst = std::max(worst, q.distortion(shapes.terms[at(k)]));
    }
  }
  return worst;
}

ResidualNorms VariationalWinslow::residual(const Coordinates& x, std::span<double> out) const {
  const TriangleData triangles = data(x, nullptr);
  const RowBlocks& rows = structure_->rows;
  std::vector<NormSum> norms(block_count(rows.rows()));
  for_each_block([&](std::size_t part, Index block, Index first, Index last, BlockMemory& memory) {
    sum_block(triangles, false, false, block, memory);
    for (Index p = first; p < last; ++p) {
      const RowSum sum = memory.row(p - first);
      norms[part].add(sum.scaled());
      if (out.empty()) continue;
      out[2 * at(rows.row(p))] = -sum.gx();
      out[2 * at(rows.row(p)) + 1] = -sum.gy();
    }
  });
  return NormSum::total(norms);
}

Linearisation VariationalWinslow::linearise(const Coordinates& x, Curvature curvature,
                                            SparseMatrix& hessian,
                                            std::span<double> residual) const {
  return assemble(data(x, nullptr), curvature == Curvature::projected, hessian, residual);
}

Linearisation VariationalWinslow::linearise_regularised(const Coordinates& x,
                                                        const Regularisation& regularisation,
                                                        SparseMatrix& hessian,
                                                        std::span<double> residual) const {
  return assemble(data(x, &regularisation), false, hessian, residual);
}

Linearisation VariationalWinslow::assemble(const TriangleData& triangles, bool project,
                                           SparseMatrix& out, std::span<double> residual) const {
  const RowBlocks& rows = structure_->rows;
  const SparsityPattern& pattern = *rows.pattern();
  out.pattern = rows.pattern();
  out.block = 2;
  out.symmetric = true;
  out.values.resize(4 * pattern.columns.size());
  std::vector<NormSum> norms(block_count(rows.rows()));
  std::vector<double> energies(norms.size(), 0.0);
  for_each_block([&](std::size_t part, Index block, Index first, Index last, BlockMemory& memory) {
    energies[part] += sum_block(triangles, project, true, block, memory);
    kernel_.write_rows(memory.matrix.data() + 4, rows.order(first), pattern.offsets.data(),
                       last - first, out.values.data());
    for (Index p = first; p < last; ++p) {
      const std::size_t row = at(rows.row(p));
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
  const std::vector<Index>& half_free = structure_->half_free;
  const std::vector<Index>& row_of_node = structure_->row_of_node;
  std::vector<double> sums((half_free.size() + 3) / 4 * 4 * TriangleSum::size);
  kernel_.sum(triangles, half_free.data(), static_cast<Index>(half_free.size()), 0, sums.data());
  std::fill(out.begin(), out.end(), 0.0);
  const PlanePoints moved(displacement);
  // out_i -= H_ij m_j for i with unknowns and j without.
  const auto subtract = [&](Index i, Index j, const double* h, bool is_transposed) {
    const Index row = row_of_node[at(i)];
    if (row < 0 || row_of_node[at(j)] >= 0) return;
    const Vec2 m = moved[j];
    out[2 * at(row)] -= h[0] * m[0] + h[is_transposed ? 2 : 1] * m[1];
    out[2 * at(row) + 1] -= h[is_transposed ? 1 : 2] * m[0] + h[3] * m[1];
  };
  const double* sum = sums.data();
  for (const Index t : half_free) {
    const auto& [a, b, c] = shapes_->triangles[at(t)];
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
