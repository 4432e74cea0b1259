#include "core/formulation/variational_winslow.h"

#include <algorithm>
#include <cmath>

#include "core/formulation/distortion.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

using distortion::Block;
using distortion::Corner2;
using distortion::Determinant;
using distortion::PenaltyFunction;
using distortion::RowTerm;

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

/// One row as it is summed up.
struct RowSum {
  double gx = 0, gy = 0;
  Block diagonal;
  double edges = 0;  // sum of |u| + |v|
  int triangles = 0;

  void add(const RowTerm& term) {
    gx += term.gradient.x;
    gy += term.gradient.y;
    diagonal.xx -= term.ij.xx + term.ik.xx;
    diagonal.xy -= term.ij.xy + term.ik.xy;
    diagonal.yx -= term.ij.yx + term.ik.yx;
    diagonal.yy -= term.ij.yy + term.ik.yy;
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
      row_of_node_(at(topology_->node_count()), -1) {
  const auto free = topology_->free_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) row_of_node_[at(free[i])] = static_cast<Index>(i);
  build_incidences();
}

void VariationalWinslow::build_incidences() {
  const auto rows = topology_->free_nodes().size();
  incidence_offsets_.assign(rows + 1, 0);
  for (const auto& nodes : shapes_.triangles) {
    for (const Index node : nodes) {
      if (const Index row = row_of_node_[at(node)]; row >= 0) ++incidence_offsets_[at(row) + 1];
    }
  }
  for (std::size_t i = 0; i < rows; ++i) incidence_offsets_[i + 1] += incidence_offsets_[i];
  incidences_.resize(at(incidence_offsets_[rows]));
  std::vector<Index> next(incidence_offsets_.begin(), incidence_offsets_.end() - 1);
  for (std::size_t t = 0; t < shapes_.triangles.size(); ++t) {
    const auto& nodes = shapes_.triangles[t];
    for (std::size_t l = 0; l < 3; ++l) {
      const Index row = row_of_node_[at(nodes[l])];
      if (row < 0) continue;
      incidences_[at(next[at(row)]++)] = {static_cast<Index>(t),
                                          static_cast<Index>(l),
                                          nodes[(l + 1) % 3],
                                          nodes[(l + 2) % 3],
                                          -1,
                                          -1};
    }
  }
  auto pattern = std::make_shared<SparsityPattern>();
  std::vector<Index> columns;
  for (std::size_t i = 0; i < rows; ++i) {
    const auto begin = incidences_.begin() + incidence_offsets_[i];
    const auto end = incidences_.begin() + incidence_offsets_[i + 1];
    columns.assign(1, static_cast<Index>(i));
    for (auto it = begin; it != end; ++it) {
      for (const Index node : {it->j, it->k}) {
        if (const Index row = row_of_node_[at(node)]; row >= 0) columns.push_back(row);
      }
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    const auto slot = [&](Index row) {
      if (row < 0) return Index{-1};
      return pattern->offsets.back() +
             static_cast<Index>(std::lower_bound(columns.begin(), columns.end(), row) -
                                columns.begin());
    };
    for (auto it = begin; it != end; ++it) {
      it->slot_j = slot(row_of_node_[at(it->j)]);
      it->slot_k = slot(row_of_node_[at(it->k)]);
    }
    pattern->diagonal.push_back(slot(static_cast<Index>(i)));
    pattern->columns.insert(pattern->columns.end(), columns.begin(), columns.end());
    pattern->offsets.push_back(static_cast<Index>(pattern->columns.size()));
  }
  pattern_ = std::move(pattern);
}

/// visit(block, row, node, incidences of the row), blocks of rows in parallel.
template <typename Visit>
void VariationalWinslow::for_each_row(Visit&& visit) const {
  const auto free = topology_->free_nodes();
  parallel_for(threads_, static_cast<Index>(free.size()), [&](Index begin, Index end) {
    const auto block = at(begin / parallel_block);
    for (Index i = begin; i < end; ++i) {
      const auto first = at(incidence_offsets_[at(i)]);
      const auto count = at(incidence_offsets_[at(i) + 1]) - first;
      visit(block, at(i), free[at(i)],
            std::span<const Incidence>(incidences_.data() + first, count));
    }
  });
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
  std::vector<NormSum> norms(block_count(static_cast<Index>(topology_->free_nodes().size())));
  for_each_row(
      [&](std::size_t block, std::size_t row, Index node, std::span<const Incidence> incidences) {
        RowSum sum;
        for (const Incidence& in : incidences) {
          const Corner2 q(x.point(node), x.point(in.j), x.point(in.k));
          for (Index k = shapes_.offsets[at(in.triangle)]; k < shapes_.offsets[at(in.triangle) + 1];
               ++k) {
            const ShapeTerm& term = shapes_.terms[at(k)];
            sum.add(distortion::row_term(q, distortion::form_at(term, in.local), term.weight, psi,
                                         {q.d, 1}, 0));
          }
          sum.edges += q.edges();
          ++sum.triangles;
        }
        norms[block].add(sum.scaled());
        if (!out.empty()) {
          out[2 * row] = -sum.gx;
          out[2 * row + 1] = -sum.gy;
        }
      });
  return NormSum::total(norms);
}

ResidualNorms VariationalWinslow::linearise(const Coordinates& x, Curvature curvature,
                                            SparseMatrix& out, std::span<double> residual,
                                            const Regularisation* regularisation) const {
  out.pattern = pattern_;
  out.block = 2;
  out.symmetric = true;
  out.values.resize(4 * pattern_->columns.size());
  std::vector<NormSum> norms(block_count(static_cast<Index>(topology_->free_nodes().size())));
  const PenaltyFunction psi(penalty_.exponent, penalty_.knee);
  const bool project = curvature == Curvature::projected && !regularisation;
  const double share = regularisation ? 0.0 : 1.0;
  for_each_row([&](std::size_t block, std::size_t row, Index node,
                   std::span<const Incidence> incidences) {
    double* values = out.values.data();
    std::fill(values + 4 * pattern_->offsets[row], values + 4 * pattern_->offsets[row + 1], 0.0);
    const auto add = [&](Index slot, const Block& b) {
      if (slot < 0) return;
      double* v = values + 4 * slot;
      v[0] += b.xx;
      v[1] += b.xy;
      v[2] += b.yx;
      v[3] += b.yy;
    };
    RowSum sum;
    for (const Incidence& in : incidences) {
      const Corner2 q(x.point(node), x.point(in.j), x.point(in.k));
      Determinant chi{q.d, 1};
      if (regularisation) {
        chi = distortion::regularised(
            q.d, regularisation->epsilon * regularisation->size[at(in.triangle)]);
      }
      for (Index k = shapes_.offsets[at(in.triangle)]; k < shapes_.offsets[at(in.triangle) + 1];
           ++k) {
        const ShapeTerm& term = shapes_.terms[at(k)];
        const distortion::Form form = distortion::form_at(term, in.local);
        const RowTerm r = project ? distortion::projected_row_term(q, form, term.weight, psi)
                                  : distortion::row_term(q, form, term.weight, psi, chi, share);
        sum.add(r);
        add(in.slot_j, r.ij);
        add(in.slot_k, r.ik);
      }
      sum.edges += q.edges();
      ++sum.triangles;
    }
    // The blocks of one row are rounded apart from those of the other: make the diagonal symmetric.
    sum.diagonal.xy = sum.diagonal.yx = 0.5 * (sum.diagonal.xy + sum.diagonal.yx);
    add(pattern_->diagonal[row], sum.diagonal);
    norms[block].add(sum.scaled());
    residual[2 * row] = -sum.gx;
    residual[2 * row + 1] = -sum.gy;
  });
  return NormSum::total(norms);
}

void VariationalWinslow::boundary_response(const Coordinates& x, const Coordinates& displacement,
                                           std::span<double> out) const {
  const PenaltyFunction psi(penalty_.exponent, penalty_.knee);
  for_each_row(
      [&](std::size_t, std::size_t row, Index node, std::span<const Incidence> incidences) {
        double rx = 0, ry = 0;
        for (const Incidence& in : incidences) {
          if (in.slot_j >= 0 && in.slot_k >= 0) continue;
          const Corner2 q(x.point(node), x.point(in.j), x.point(in.k));
          for (Index k = shapes_.offsets[at(in.triangle)]; k < shapes_.offsets[at(in.triangle) + 1];
               ++k) {
            const ShapeTerm& term = shapes_.terms[at(k)];
            const RowTerm r = distortion::row_term(q, distortion::form_at(term, in.local),
                                                   term.weight, psi, {q.d, 1}, 1);
            const auto subtract = [&](const Block& b, Index moved) {
              const double* m = displacement.point(moved);
              rx -= b.xx * m[0] + b.xy * m[1];
              ry -= b.yx * m[0] + b.yy * m[1];
            };
            if (in.slot_j < 0) subtract(r.ij, in.j);
            if (in.slot_k < 0) subtract(r.ik, in.k);
          }
        }
        out[2 * row] = rx;
        out[2 * row + 1] = ry;
      });
}

}  // namespace winslow
