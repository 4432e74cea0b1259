#include "core/formulation/variational_winslow.h"

#include "core/formulation/distortion.h"
#include "core/formulation/gradient_parts.h"
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

/// Targets in the order of `old_number`.
template <int D>
CellTargets<D> reordered(const CellTargets<D>& shapes, const std::vector<Index>& old_number,
                         int threads) {
  CellTargets<D> out;
  out.stretched = shapes.stretched;
  out.without_shape = shapes.without_shape;
  out.offsets.reserve(old_number.size() + 1);
  for (const Index t : old_number)
    out.offsets.push_back(out.offsets.back() + static_cast<Index>(shapes.terms_of(at(t)).size()));
  out.cells.resize(old_number.size());
  out.terms.resize(at(out.offsets.back()));
  if (!shapes.inverse_limits.empty()) out.inverse_limits.resize(out.terms.size());
  parallel_for(threads, static_cast<Index>(old_number.size()), [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const std::size_t t = at(old_number[at(i)]);
      out.cells[at(i)] = shapes.cells[t];
      const Index first = out.offsets[at(i)];
      std::ranges::copy(shapes.terms_of(t), out.terms.begin() + first);
      if (out.inverse_limits.empty()) continue;
      std::copy(shapes.inverse_limits.begin() + shapes.offsets[t],
                shapes.inverse_limits.begin() + shapes.offsets[t + 1],
                out.inverse_limits.begin() + first);
    }
  });
  return out;
}

template <int D>
std::array<Vec<D>, D + 1> points_of(const double* x, const std::array<Index, D + 1>& nodes) {
  std::array<Vec<D>, D + 1> points;
  for (std::size_t k = 0; k <= D; ++k)
    points[k] = Vec<D>(x + D * static_cast<std::ptrdiff_t>(nodes[k]));
  return points;
}

double determinant(const std::array<Vec2, 3>& p) {
  const Vec2 u = p[1] - p[0], v = p[2] - p[0];
  return u.x() * v.y() - u.y() * v.x();
}
double determinant(const std::array<Vec3, 4>& p) {
  return (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]));
}

/// Replaces the Hessians of the cells in the sums by projected ones.
void project(const CellTargets<2>& shapes, const double* x, const PenaltyFunction& psi,
             std::span<const Index> cells, double* sums) {
  for (const Index t : cells) {
    const distortion::Corner2 corner(points_of<2>(x, shapes.cells[at(t)]));
    distortion::project_blocks(corner, shapes, at(t), psi, sums);
    sums += Layout<2>::sum;
  }
}

}  // namespace

/// Work memory for the sums of one block of rows.
template <int D>
struct SimplexWinslow<D>::BlockMemory {
  static constexpr std::size_t chunk = D == 2 ? 64 : 32;  // cells whose sums stay in fast caches
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
    : TargetForm<D>(pattern.nodes,
                    std::make_shared<Targets>(
                        reordered(shapes, pattern.structure->shape_order, pattern.nodes.threads())),
                    penalty),
      structure_(pattern.structure) {
  this->node_unknowns().require_held_boundary("the variational form");
}

template <int D>
std::shared_ptr<const VariationalForm> SimplexWinslow<D>::with_targets(
    std::shared_ptr<const SimplexWinslow> form, const TargetsOfSome<D>& some) {
  const auto structure = form->structure_;
  std::vector<Index> place(structure->shape_order.size());  // by the number in the targets as given
  for (std::size_t t = 0; t < place.size(); ++t)
    place[at(structure->shape_order[t])] = static_cast<Index>(t);
  auto other = std::make_shared<SimplexWinslow>(*form);
  form.reset();
  Targets& shapes = other->own_shapes();
  for (std::size_t k = 0; k < some.cells.size(); ++k) {
    const std::size_t t = at(place[at(some.cells[k])]);
    const auto terms = some.targets.terms_of(k);
    if (some.targets.cells[k] != shapes.cells[t] || terms.size() != shapes.terms_of(t).size())
      throw UsageError("targets of other cells than those of the form");
    std::ranges::copy(terms, shapes.terms_of(t).begin());
    if (shapes.inverse_limits.empty()) continue;
    std::copy_n(some.targets.inverse_limits.begin() + some.targets.offsets[k], terms.size(),
                shapes.inverse_limits.begin() + shapes.offsets[t]);
  }
  return other;
}

template <int D>
std::size_t SimplexWinslow<D>::structure_bytes() const {
  const auto& parts = structure_->parts.made;
  return structure_->bytes() + (parts ? parts->bytes() : 0);
}

template <int D>
std::unique_ptr<const TargetPath> SimplexWinslow<D>::target_path(const Coordinates& from) const {
  return std::make_unique<ShapePath<D>>(copy(), Points<D>(from), this->threads());
}

template <int D>
SimplexData SimplexWinslow<D>::data(const Coordinates& x,
                                    const Regularisation* regularisation) const {
  x.require_dimension(D);
  const auto& cells = this->shapes().cells;
  static_assert(sizeof(cells[0]) == (D + 1) * sizeof(Index));
  return TargetForm<D>::data(x.values().data(), cells.empty() ? nullptr : cells.front().data(),
                             regularisation);
}

template <int D>
std::vector<double> SimplexWinslow<D>::determinants(const Coordinates& x,
                                                    Regularisation* /*held*/) const {
  x.require_dimension(D);
  std::vector<double> list;
  list.reserve(this->shapes().cells.size());
  for (const auto& nodes : this->shapes().cells)
    list.push_back(determinant(points_of<D>(x.values().data(), nodes)));
  return list;
}

/// visit(part, block, first and last position of the block's rows, work memory), blocks in
/// parallel; a part is the range of one NormSum.
template <int D>
template <typename Visit>
void SimplexWinslow<D>::for_each_block(Visit&& visit) const {
  constexpr Index rows_per_block = RowBlocks<D>::rows_per_block;
  static_assert(parallel_block % rows_per_block == 0);
  parallel_for(this->threads(), structure_->rows.rows(), [&](Index begin, Index end) {
    BlockMemory memory;
    for (Index first = begin; first < end; first += rows_per_block) {
      visit(at(begin / parallel_block), first / rows_per_block, first,
            std::min(end, first + rows_per_block), memory);
    }
  });
}

/// Computes the sums of a block's rows and, if with_matrix, its part of the Hessian. With the
/// matrix, returns the energy of the cells that are in no earlier block.
template <int D>
double SimplexWinslow<D>::sum_block(const SimplexData& data, bool is_projected, bool with_matrix,
                                    Index block, BlockMemory& memory) const {
  const distortion::SimplexKernel<D>& kernel = this->kernel();
  const RowBlocks<D>& rows = structure_->rows;
  std::fill(memory.rows.begin(), memory.rows.end(), 0.0);
  if (with_matrix) memory.matrix.assign(D * D * at(rows.entries(block)), 0.0);
  const auto cells = rows.cells(block);
  const auto places = rows.places(block);
  double energy = 0;
  for (std::size_t first = 0; first < cells.size(); first += BlockMemory::chunk) {
    const auto part = cells.subspan(first, std::min(BlockMemory::chunk, cells.size() - first));
    const auto count = static_cast<Index>(part.size());
    if (!with_matrix && kernel.sum_gradients) {
      kernel.sum_gradients(data, part.data(), count, memory.sums.data());
      kernel.scatter_gradients(memory.sums.data(), places.data() + first, count,
                               memory.rows.data());
      continue;
    }
    const auto sum = is_projected && kernel.sum_projected ? kernel.sum_projected : kernel.sum;
    energy += sum(data, part.data(), count, rows.first_new_cell(block), memory.sums.data());
    if constexpr (D == 2) {
      if (is_projected) project(this->shapes(), data.x, this->psi(), part, memory.sums.data());
    }
    kernel.scatter(memory.sums.data(), places.data() + first, count, memory.rows.data(),
                   with_matrix ? memory.matrix.data() : nullptr);
  }
  return energy;
}

template <int D>
std::shared_ptr<const VariationalForm> SimplexWinslow<D>::with_corner_lengths(
    const Coordinates& x) const {
  return this->with_shapes(
      std::make_shared<const Targets>(winslow::with_corner_lengths(this->shapes(), Points<D>(x))));
}

template <int D>
double SimplexWinslow<D>::worst(const Coordinates& x, bool of_guards) const {
  x.require_dimension(D);
  const auto corner = [&](std::size_t t) {
    return distortion::Corner<D>(points_of<D>(x.values().data(), this->shapes().cells[t]));
  };
  return this->worst_of(corner, of_guards);
}

/// Null for a plane mesh: its curves have folds only at corners, which are fixed.
template <int D>
std::shared_ptr<const EnergyProblem> SimplexWinslow<D>::holding_stuck_nodes(
    const Coordinates& x, std::span<const double> direction, double step) const {
  if constexpr (D == 2) return nullptr;
  Coordinates there = x;
  this->advance(direction, step, there);
  std::vector<bool> stuck = this->stuck_rows();
  add_nodes_led_astray(this->node_unknowns(), x, there, direction, D, step, stuck);
  return this->holding(std::move(stuck));
}

template <int D>
ResidualNorms SimplexWinslow<D>::residual(const Coordinates& x, std::span<double> out) const {
  const SimplexData cells = data(x, nullptr);
  const RowBlocks<D>& rows = structure_->rows;
  std::vector<NormSum> norms(block_count(rows.rows()));
  RowReduction<D> reduction(*structure_, this->node_unknowns(), x, this->stuck());
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
Linearisation SimplexWinslow<D>::assemble(const Coordinates& x,
                                          const Regularisation* regularisation, bool projected,
                                          SparseMatrix& hessian, std::span<double> residual) const {
  const SimplexData cells = data(x, regularisation);
  const RowBlocks<D>& rows = structure_->rows;
  const SparsityPattern& pattern = *rows.pattern();
  RowReduction<D> reduction(*structure_, this->node_unknowns(), x, this->stuck());
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
    energies[part] += sum_block(cells, projected, true, block, memory);
    this->kernel().write_rows(memory.matrix.data() + D * D, rows.order(first),
                              pattern.offsets.data(), last - first, out.values.data());
    for (Index p = first; p < last; ++p) {
      const std::size_t row = at(rows.row(p));
      const RowSum<D> sum = memory.row(p - first);
      double* diagonal =
          out.values.data() + block_size * static_cast<std::ptrdiff_t>(pattern.diagonal[row]);
      // The parts round differently: make the diagonal symmetric.
      for (int i = 0; i < D; ++i) {
        for (int j = 0; j < D; ++j)
          diagonal[D * i + j] =
              i == j ? sum.v[(D + 1) * i] : 0.5 * (sum.v[D * i + j] + sum.v[D * j + i]);
      }
      reduction.add_norm(row, sum, norms[part]);
      for (std::size_t k = 0; k < D; ++k) full[D * row + k] = -sum.gradient()[k];
    }
  });
  reduction.reduce(full, projected || regularisation, out, hessian);
  reduction.reduce(full, residual, &norms);
  return {NormSum::total(norms), std::accumulate(energies.begin(), energies.end(), 0.0)};
}

template <int D>
void SimplexWinslow<D>::boundary_response(const Coordinates& x, const Coordinates& displacement,
                                          std::span<double> out) const {
  RowReduction<D> reduction(*structure_, this->node_unknowns(), x, this->stuck());
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
    this->kernel().sum(cells, half_free.data() + begin, static_cast<Index>(count), 0, sums.data());
    for (std::size_t i = 0; i < count; ++i) {
      const double* block = sums.data() + Layout<D>::sum * static_cast<std::ptrdiff_t>(i);
      const auto& nodes = this->shapes().cells[at(half_free[begin + i])];
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

namespace {

/// Calls visit(cell, its sum) for all cells in ascending order. The sums are computed in parallel.
template <int D, typename Visit>
void for_each_sum(const distortion::SimplexKernel<D>& kernel, const SimplexData& data, Index cells,
                  int threads, const Visit& visit) {
  constexpr Index chunk = 4096, block = 256, room = 3;
  std::vector<double> sums(at(chunk + room) * Layout<D>::sum);
  std::vector<Index> list(at(chunk));
  for (Index begin = 0; begin < cells; begin += chunk) {
    const Index count = std::min(chunk, cells - begin);
    std::iota(list.begin(), list.begin() + count, begin);
    parallel_for(
        threads, count,
        [&](Index first, Index last) {
          // The kernel writes up to three sums more than asked for: keep them off other blocks.
          std::vector<double> own(at(last - first + room) * Layout<D>::sum);
          kernel.sum(data, list.data() + first, last - first, 0, own.data());
          std::copy_n(own.begin(), at(last - first) * Layout<D>::sum,
                      sums.begin() + first * Layout<D>::sum);
        },
        block);
    for (Index i = 0; i < count; ++i) visit(begin + i, sums.data() + i * Layout<D>::sum);
  }
}

}  // namespace

template <int D>
Coordinates SimplexWinslow<D>::hessian_product(const Coordinates& x,
                                               const Coordinates& velocities) const {
  Coordinates out(D, x.size());
  const Points<D> v(velocities);
  using Block = Eigen::Map<const Eigen::Matrix<double, D, D, Eigen::RowMajor>>;
  const auto count = static_cast<Index>(this->shapes().cells.size());
  for_each_sum<D>(this->kernel(), data(x, nullptr), count, this->threads(),
                  [&](Index cell, const double* block) {
                    const auto& nodes = this->shapes().cells[at(cell)];
                    for (std::size_t a = 0; a <= D; ++a) {
                      for (std::size_t b = a + 1; b <= D; ++b, block += std::ptrdiff_t{D} * D) {
                        // The blocks of a row sum to zero.
                        const Vec<D> relative = v[nodes[b]] - v[nodes[a]];
                        const Block h(block);
                        out.set<D>(nodes[a], out.get<D>(nodes[a]) + h * relative);
                        out.set<D>(nodes[b], out.get<D>(nodes[b]) - h.transpose() * relative);
                      }
                    }
                  });
  return out;
}

template <int D>
void SimplexWinslow<D>::velocities_transpose(const Coordinates& x, const Coordinates& forces,
                                             std::span<double> out) const {
  RowReduction<D> reduction(*structure_, this->node_unknowns(), x, this->stuck());
  const std::span<double> full = reduction.all_rows(out);
  const std::vector<Index>& row_of_node = structure_->row_of_node;
  const Points<D> of(forces);
  for (Index node = 0; node < x.size(); ++node)
    if (const Index row = row_of_node[at(node)]; row >= 0)
      Eigen::Map<Vec<D>>(full.data() + D * at(row)) = of[node];
  reduction.reduce(full, out, nullptr);
}

template <int D>
std::vector<double> SimplexWinslow<D>::cell_gradients(const Coordinates& x,
                                                      const Targets& targets) const {
  x.require_dimension(D);
  const auto count = static_cast<Index>(targets.cells.size());
  std::vector<double> out(at(count) * (D + 1) * D);
  if (count == 0) return out;
  const SimplexData seen =
      TargetForm<D>::data(targets, x.values().data(), targets.cells.front().data(), nullptr);
  constexpr std::ptrdiff_t gradient = D == 2 ? 0 : Layout<D>::gradient;
  for_each_sum<D>(this->kernel(), seen, count, this->threads(), [&](Index cell, const double* sum) {
    double* own = &out[at(cell) * (D + 1) * D];
    for (std::ptrdiff_t k = 0; k <= D; ++k)
      std::copy_n(sum + Layout<D>::corners + k * Layout<D>::corner + gradient, D, own + k * D);
  });
  return out;
}

/// The form of a volume mesh. Its rows are those of RowBlocks.
class VolumeFirstOrder final : public FirstOrderForm {
 public:
  VolumeFirstOrder(const VolumeWinslow& form, const GradientParts& parts)
      : form_(form), parts_(parts) {
    const auto nodes = form_.node_unknowns().nodes();
    const std::vector<bool> stuck = form_.stuck_rows();
    for (std::size_t row = 0; row < nodes.size(); ++row)
      if (form_.structure_->sliding.slot(row) >= 0)
        sliding_.push_back({at(parts.position(row)), nodes[row], stuck[row]});
    const Topology& topology = form_.topology();
    for (Index e = 0; e < topology.element_count(); ++e)
      is_barrier_ &= topology.element_type(e) == ElementType::tetrahedron;
  }

  Index rows() const override { return static_cast<Index>(parts_.nodes().size()); }
  bool is_barrier() const override { return is_barrier_; }
  double gradient(const Coordinates& x, std::span<double> out) const override {
    const double energy =
        parts_.gradient(form_.kernel(), form_.data(x, nullptr), form_.threads(), out);
    for (const Sliding& of : sliding_) {
      Eigen::Map<Vec3> own(out.data() + 3 * of.position);
      Vec3 along = Vec3::Zero();
      for (const Vec3& direction : frame_of(of, x)) along += direction.dot(own) * direction;
      own = along;
    }
    return energy;
  }
  void scales(const Coordinates& x, std::span<double> out) const override {
    const auto& structure = *form_.structure_;
    std::vector<double> sums(2 * out.size());
    parts_.scales(form_.kernel(), form_.data(x, nullptr), form_.threads(), sums);
    for (Index p = 0; p < rows(); ++p) {
      const double* own = &sums[2 * at(p)];
      const Index count = structure.cells_at_row[at(structure.rows.row(p))];
      out[at(p)] = 1 / RowSum<3>::Scale{own[1], own[0], count}.scaled(1);
    }
  }
  void positions(const Coordinates& x, std::span<double> out) const override {
    const SpacePoints points(x);
    parallel_for(form_.threads(), rows(), [&](Index begin, Index end) {
      for (auto p = at(begin); p < at(end); ++p)
        Eigen::Map<Vec3>(out.data() + 3 * p) = points[parts_.nodes()[p]];
    });
  }
  void rates(const Coordinates& x, std::span<const double> vectors,
             std::span<double> out) const override {
    const auto count = static_cast<Index>(form_.node_unknowns().nodes().size());
    parallel_for(form_.threads(), count, [&](Index begin, Index end) {
      for (auto row = at(begin); row < at(end); ++row)
        Eigen::Map<Vec3>(out.data() + 3 * row) =
            Eigen::Map<const Vec3>(vectors.data() + 3 * at(parts_.position(row)));
    });
    for (const Sliding& of : sliding_) {
      const Eigen::Map<const Vec3> own(vectors.data() + 3 * of.position);
      double* to = &out[3 * at(form_.structure_->row_of_node[at(of.node)])];
      std::fill_n(to, 3, 0.0);
      for (const Vec3& direction : frame_of(of, x)) *to++ = direction.dot(own);
    }
  }
  void laplacian(const Coordinates& x, SparseMatrix& out) const override {
    parts_.laplacian(form_.kernel(), form_.data(x, nullptr), form_.structure_->rows,
                     form_.threads(), out);
  }

 private:
  struct Sliding {
    std::size_t position;
    Index node;
    bool stuck;
  };
  TangentFrame frame_of(const Sliding& of, const Coordinates& x) const {
    if (of.stuck) return {};
    return form_.node_unknowns().classes().foot(of.node, x.xyz(of.node)).frame;
  }

  VolumeWinslow form_;  // shares its structure, which has the parts
  const GradientParts& parts_;
  std::vector<Sliding> sliding_;
  bool is_barrier_ = true;
};

template <int D>
std::shared_ptr<const FirstOrderForm> SimplexWinslow<D>::first_order() const {
  if constexpr (D == 3) {
    if (structure_->joins()) return nullptr;
    auto& parts = structure_->parts;
    std::call_once(parts.once, [&] {
      parts.made = std::make_shared<const GradientParts>(structure_->rows, this->shapes().cells,
                                                         structure_->row_of_node);
    });
    return std::make_shared<const VolumeFirstOrder>(*this, *parts.made);
  } else {
    return nullptr;
  }
}

template class SimplexWinslow<2>;
template class SimplexWinslow<3>;

}  // namespace winslow
