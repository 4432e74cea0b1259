#include "core/formulation/variational_winslow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/formulation/distortion.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

using distortion::Block;
using distortion::Corner2;
using distortion::Determinant;
using distortion::Form;
using distortion::PenaltyFunction;
using distortion::TriangleTerm;
using distortion::Vector;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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

Block transposed(const Block& b) { return {b.xx, b.yx, b.xy, b.yy}; }

void accumulate(Vector& sum, const Vector& v) {
  sum.x += v.x;
  sum.y += v.y;
}

std::vector<Index> make_row_of_node(const Topology& topology) {
  std::vector<Index> row(at(topology.node_count()), -1);
  const auto free = topology.free_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) row[at(free[i])] = static_cast<Index>(i);
  return row;
}

}  // namespace

/// All terms of one triangle (a, b, c), and the lengths of its edges.
struct VariationalWinslow::TriangleSum {
  std::array<Vector, 3> gradient;
  Block ab, ac, bc;
  double length_ab, length_ac, length_bc;

  void add(const TriangleTerm& term) {
    accumulate(gradient[0], term.a);
    accumulate(gradient[1], term.b);
    accumulate(gradient[2], term.c);
    ab += term.ab;
    ac += term.ac;
    bc += term.bc;
  }
  /// The triangle as its corner `local` sees it: blocks towards the next corner and the one after.
  std::pair<Block, Block> row(Index local) const {
    if (local == 0) return {ab, ac};
    if (local == 1) return {bc, transposed(ab)};
    return {transposed(ac), transposed(bc)};
  }
  double edges(Index local) const {
    if (local == 0) return length_ab + length_ac;
    return local == 1 ? length_ab + length_bc : length_ac + length_bc;
  }
};

namespace {

/// One row as it is summed up.
struct RowSum {
  double gx = 0, gy = 0;
  Block diagonal;
  double edges = 0;  // sum of the two at the node, over its triangles
  int triangles = 0;

  void add(const Vector& gradient, const Block& ij, const Block& ik, double lengths) {
    gx += gradient.x;
    gy += gradient.y;
    diagonal.xx -= ij.xx + ik.xx;
    diagonal.xy -= ij.xy + ik.xy;
    diagonal.yx -= ij.yx + ik.yx;
    diagonal.yy -= ij.yy + ik.yy;
    edges += lengths;
    ++triangles;
  }
  /// Distance by which the node alone would move, over the mean edge.
  double scaled() const {
    const double mean_edge = edges / (2 * std::max(triangles, 1));
    const double scale = 0.5 * (diagonal.xx + diagonal.yy) * mean_edge;
    const double g = std::sqrt(gx * gx + gy * gy);
    return scale > 0 ? g / scale : g;
  }
};

}  // namespace

VariationalWinslow::VariationalWinslow(std::shared_ptr<const Topology> topology,
                                       TargetShapes shapes, const PenaltyOptions& penalty,
                                       int threads)
    : topology_(std::move(topology)),
      shapes_(std::move(shapes)),
      penalty_(penalty),
      threads_(threads),
      row_of_node_(make_row_of_node(*topology_)),
      rows_(shapes_.triangles, row_of_node_, static_cast<Index>(topology_->free_nodes().size())) {}

/// visit(part, block, first and last position of the block's rows, memory to work in), blocks in
/// parallel; a part is what one sum of norms covers.
template <typename Visit>
void VariationalWinslow::for_each_block(Visit&& visit) const {
  static_assert(parallel_block % RowBlocks::rows_per_block == 0);
  parallel_for(threads_, rows_.rows(), [&](Index begin, Index end) {
    TriangleSums memory;
    for (Index first = begin; first < end; first += RowBlocks::rows_per_block) {
      visit(at(begin / parallel_block), first / RowBlocks::rows_per_block, first,
            std::min(end, first + RowBlocks::rows_per_block), memory);
    }
  });
}

/// term(triangle, its edges and determinant, target's form, weight) gives a TriangleTerm.
template <typename Term>
void VariationalWinslow::sum_triangles(Index block, const Coordinates& x, const Term& term,
                                       TriangleSums& out) const {
  const auto triangles = rows_.triangles(block);
  out.resize(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Index t = triangles[i];
    const auto& nodes = shapes_.triangles[at(t)];
    const Corner2 q(x.point(nodes[0]), x.point(nodes[1]), x.point(nodes[2]));
    TriangleSum& sum = out[i];
    sum = {};
    for (Index k = shapes_.offsets[at(t)]; k < shapes_.offsets[at(t) + 1]; ++k) {
      const ShapeTerm& shape = shapes_.terms[at(k)];
      sum.add(term(t, q, distortion::form_at(shape, 0), shape.weight));
    }
    const double wx = q.vx - q.ux, wy = q.vy - q.uy;
    sum.length_ab = std::sqrt(q.ux * q.ux + q.uy * q.uy);
    sum.length_ac = std::sqrt(q.vx * q.vx + q.vy * q.vy);
    sum.length_bc = std::sqrt(wx * wx + wy * wy);
  }
}

double VariationalWinslow::energy(const Coordinates& x,
                                  const Regularisation* regularisation) const {
  const PenaltyFunction psi(penalty_.exponent, penalty_.knee);
  const auto n = static_cast<Index>(shapes_.triangles.size());
  std::vector<double> sums(block_count(n), 0.0);
  parallel_for(threads_, n, [&](Index begin, Index end) {
    double sum = 0;
    for (Index t = begin; t < end; ++t) {
      const auto& nodes = shapes_.triangles[at(t)];
      const Corner2 q(x.point(nodes[0]), x.point(nodes[1]), x.point(nodes[2]));
      double d = q.d;
      if (regularisation) {
        d = distortion::regularised(d, regularisation->epsilon * regularisation->size[at(t)]).value;
      }
      if (!(d > 0)) {
        sum = std::numeric_limits<double>::infinity();
        break;
      }
      for (Index k = shapes_.offsets[at(t)]; k < shapes_.offsets[at(t) + 1]; ++k) {
        const ShapeTerm& term = shapes_.terms[at(k)];
        const double f = 0.5 * q.form(distortion::form_at(term, 0)) / d;
        sum += term.weight * psi(f).value;
      }
    }
    sums[at(begin / parallel_block)] = sum;
  });
  double total = 0;
  for (const double sum : sums) total += sum;
  return total;
}

double VariationalWinslow::worst_distortion(const Coordinates& x) const {
  double worst = 0;
  for (std::size_t t = 0; t < shapes_.triangles.size(); ++t) {
    const auto& nodes = shapes_.triangles[t];
    const Corner2 q(x.point(nodes[0]), x.point(nodes[1]), x.point(nodes[2]));
    if (!(q.d > 0)) return std::numeric_limits<double>::infinity();
    for (Index k = shapes_.offsets[t]; k < shapes_.offsets[t + 1]; ++k) {
      worst = std::max(worst, 0.5 * q.form(distortion::form_at(shapes_.terms[at(k)], 0)) / q.d);
    }
  }
  return worst;
}

ResidualNorms VariationalWinslow::residual(const Coordinates& x, bool,
                                           std::span<double> out) const {
  const PenaltyFunction psi(penalty_.exponent, penalty_.knee);
  std::vector<NormSum> norms(block_count(rows_.rows()));
  for_each_block([&](std::size_t part, Index block, Index first, Index last, TriangleSums& sums) {
    sum_triangles(
        block, x,
        [&](Index, const Corner2& q, const Form& form, double weight) {
          return distortion::triangle_term(q, form, weight, psi, {q.d, 1}, 0);
        },
        sums);
    for (Index p = first; p < last; ++p) {
      RowSum sum;
      for (const RowBlocks::Incidence& in : rows_.incidences(p)) {
        const TriangleSum& triangle = sums[at(in.triangle)];
        const auto [ij, ik] = triangle.row(in.local);
        sum.add(triangle.gradient[at(in.local)], ij, ik, triangle.edges(in.local));
      }
      norms[part].add(sum.scaled());
      if (out.empty()) continue;
      out[2 * at(rows_.row(p))] = -sum.gx;
      out[2 * at(rows_.row(p)) + 1] = -sum.gy;
    }
  });
  return NormSum::total(norms);
}

ResidualNorms VariationalWinslow::linearise(const Coordinates& x, Curvature curvature,
                                            SparseMatrix& out, std::span<double> residual,
                                            const Regularisation* regularisation) const {
  const SparsityPattern& pattern = *rows_.pattern();
  out.pattern = rows_.pattern();
  out.block = 2;
  out.symmetric = true;
  out.values.resize(4 * pattern.columns.size());
  std::vector<NormSum> norms(block_count(rows_.rows()));
  const PenaltyFunction psi(penalty_.exponent, penalty_.knee);
  const bool project = curvature == Curvature::projected && !regularisation;
  const auto term = [&](Index t, const Corner2& q, const Form& form, double weight) {
    if (project) return distortion::projected_triangle_term(q, form, weight, psi);
    if (!regularisation) return distortion::triangle_term(q, form, weight, psi, {q.d, 1}, 1);
    const Determinant chi =
        distortion::regularised(q.d, regularisation->epsilon * regularisation->size[at(t)]);
    return distortion::triangle_term(q, form, weight, psi, chi, 0);
  };
  double* values = out.values.data();
  const auto add = [values](Index slot, const Block& b) {
    if (slot < 0) return;
    double* v = values + 4 * static_cast<std::ptrdiff_t>(slot);
    v[0] += b.xx;
    v[1] += b.xy;
    v[2] += b.yx;
    v[3] += b.yy;
  };
  for_each_block([&](std::size_t part, Index block, Index first, Index last, TriangleSums& sums) {
    sum_triangles(block, x, term, sums);
    for (Index p = first; p < last; ++p) {
      const std::size_t row = at(rows_.row(p));
      std::fill(values + 4 * static_cast<std::ptrdiff_t>(pattern.offsets[row]),
                values + 4 * static_cast<std::ptrdiff_t>(pattern.offsets[row + 1]), 0.0);
      RowSum sum;
      for (const RowBlocks::Incidence& in : rows_.incidences(p)) {
        const TriangleSum& triangle = sums[at(in.triangle)];
        const auto [ij, ik] = triangle.row(in.local);
        sum.add(triangle.gradient[at(in.local)], ij, ik, triangle.edges(in.local));
        add(in.slot_j, ij);
        add(in.slot_k, ik);
      }
      // Its parts are rounded apart: make the diagonal symmetric.
      sum.diagonal.xy = sum.diagonal.yx = 0.5 * (sum.diagonal.xy + sum.diagonal.yx);
      add(pattern.diagonal[row], sum.diagonal);
      norms[part].add(sum.scaled());
      residual[2 * row] = -sum.gx;
      residual[2 * row + 1] = -sum.gy;
    }
  });
  return NormSum::total(norms);
}

void VariationalWinslow::boundary_response(const Coordinates& x, const Coordinates& displacement,
                                           std::span<double> out) const {
  const PenaltyFunction psi(penalty_.exponent, penalty_.knee);
  for_each_block([&](std::size_t, Index block, Index first, Index last, TriangleSums& sums) {
    const auto triangles = rows_.triangles(block);
    sum_triangles(
        block, x,
        [&](Index, const Corner2& q, const Form& form, double weight) {
          return distortion::triangle_term(q, form, weight, psi, {q.d, 1}, 1);
        },
        sums);
    for (Index p = first; p < last; ++p) {
      double rx = 0, ry = 0;
      for (const RowBlocks::Incidence& in : rows_.incidences(p)) {
        if (in.slot_j >= 0 && in.slot_k >= 0) continue;
        const auto& nodes = shapes_.triangles[at(triangles[at(in.triangle)])];
        const auto [ij, ik] = sums[at(in.triangle)].row(in.local);
        const auto subtract = [&](const Block& b, Index step) {
          const double* m = displacement.point(nodes[at((in.local + step) % 3)]);
          rx -= b.xx * m[0] + b.xy * m[1];
          ry -= b.yx * m[0] + b.yy * m[1];
        };
        if (in.slot_j < 0) subtract(ij, 1);
        if (in.slot_k < 0) subtract(ik, 2);
      }
      out[2 * at(rows_.row(p))] = rx;
      out[2 * at(rows_.row(p)) + 1] = ry;
    }
  });
}

}  // namespace winslow
