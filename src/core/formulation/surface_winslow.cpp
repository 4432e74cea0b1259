#include "core/formulation/surface_winslow.h"

#include "core/error.h"
#include "core/formulation/row_elimination.h"
#include "core/formulation/target_metric.h"
#include "core/formulation/target_path.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

using distortion::PenaltyFunction;
using distortion::SimplexData;
using Layout = distortion::SimplexLayout<2>;
using Block = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;

/// Number of a pair of a cell's nodes, a < b: 01, 02, 12.
constexpr std::size_t pair_of(std::size_t a, std::size_t b) { return a + b - 1; }

distortion::Corner2 corner_of(const FlatCells& cells, std::size_t cell) {
  const double* p = cells.x.data() + 6 * cell;
  return {p, p + 2, p + 4};
}

/// The numbers z of a cell's pairs (01, 02, 12) define the quadratic form -sum z_ij (h_i - h_j)^2
/// of heights over its plane. This function keeps the positive semidefinite part. With h = a b1 + b
/// b2, b1 = (1, -1, 0) / sqrt 2 and b2 = (1, 1, -2) / sqrt 6, the form is a 2 by 2 matrix.
void keep_convex(double* z) {
  if (z[0] <= 0 && z[1] <= 0 && z[2] <= 0) return;
  const double half_root_3 = 0.5 * std::sqrt(3.0);
  Eigen::Matrix2d m;
  m(0, 0) = -2 * z[0] - 0.5 * (z[1] + z[2]);
  m(0, 1) = m(1, 0) = half_root_3 * (z[2] - z[1]);
  m(1, 1) = -1.5 * (z[1] + z[2]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(m);
  if (eigen.eigenvalues()[0] >= 0) return;
  m = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
      eigen.eigenvectors().transpose();
  const double sum = -m(1, 1) / 1.5, difference = m(0, 1) / half_root_3;  // z1 + z2, z2 - z1
  z[0] = -0.5 * (m(0, 0) + 0.5 * sum);
  z[1] = 0.5 * (sum - difference);
  z[2] = 0.5 * (sum + difference);
}

}  // namespace

/// The kernel's sums for all cells, the numbers z of each pair of nodes (01, 02, 12), and for each
/// pair the block of the Hessian with respect to the unknowns, with the rows of the first node.
struct SurfaceWinslow::CellSums {
  static constexpr std::size_t lanes = 4;  // the kernel writes full packs
  static std::size_t size(std::size_t cells) {
    return (cells + lanes) * Layout::sum + (3 + 12) * cells;
  }

  CellSums(KeptMemory& lender, std::size_t cells)
      : memory(lender),
        numbers(lender.borrow()),
        sums(numbers.get()),
        z(sums + (cells + lanes) * Layout::sum),
        blocks(z + 3 * cells) {}
  ~CellSums() { memory.give_back(std::move(numbers)); }
  CellSums(const CellSums&) = delete;
  CellSums& operator=(const CellSums&) = delete;

  KeptMemory& memory;
  std::unique_ptr<double[]> numbers;
  double* sums;        // Layout::sum for each cell
  double* z;           // 3 for each cell, if `bends`
  double* blocks;      // 12 for each cell: see find_blocks()
  bool bends = false;  // z is not zero
  double energy = 0;

  const double* corner(Index t, std::size_t c) const {
    return sums + Layout::sum * t + Layout::corners +
           Layout::corner * static_cast<std::ptrdiff_t>(c);
  }
  /// The block in the row of one node of a cell at another.
  Block block(Index t, std::size_t c, std::size_t j) const {
    const double* first = sums + Layout::sum * t;
    if (c < j) return Eigen::Map<const Block>(first + 4 * pair_of(c, j));
    return Eigen::Map<const Block>(first + 4 * pair_of(j, c)).transpose();
  }
  double z_of(Index t, std::size_t c, std::size_t j) const {
    return !bends ? 0 : z[3 * at(t) + pair_of(std::min(c, j), std::max(c, j))];
  }
  /// As block(), with respect to the unknowns.
  Block unknowns_block(Index t, std::size_t c, std::size_t j) const {
    const double* first = blocks + 12 * at(t);
    if (c < j) return Eigen::Map<const Block>(first + 4 * pair_of(c, j));
    return Eigen::Map<const Block>(first + 4 * pair_of(j, c)).transpose();
  }
};

/// Sums over the cells around one row.
struct SurfaceWinslow::RowSums {
  Vec3 gradient{0, 0, 0};
  RowSum<2>::Scale scale;
};

SurfaceWinslow::Pattern::Pattern(std::shared_ptr<const NodeClasses> classes, const Targets& targets,
                                 int threads)
    : nodes(std::move(classes), threads, NodeUnknowns::Layout::blocks) {
  nodes.require_sliding("the variational form");
  for (const auto& cell : targets.cells)
    for (const Index node : cell)
      if (nodes.classes()[node] == NodeClass::prescribed)
        throw UsageError("motions: only for plane and volume meshes, and this is a surface mesh");
  if (!nodes.classes().sliding().element_normals())
    throw UsageError("the variational form of a surface mesh needs the normals of its elements");
  auto made = std::make_shared<SurfaceStructure>(nodes, targets.cells);
  made->memory = std::make_shared<KeptMemory>(CellSums::size(targets.cells.size()));
  structure = std::move(made);
}

std::unique_ptr<const TargetPath> SurfaceWinslow::target_path(const Coordinates& from) const {
  return std::make_unique<ShapePath<2>>(copy(), SpacePoints(from), threads());
}

std::vector<Vec3> SurfaceWinslow::normals(const Coordinates& x) const {
  return element_normals(node_unknowns().classes(), x, threads());
}

FlatCells SurfaceWinslow::lay_flat(const Coordinates& x,
                                   const Regularisation* regularisation) const {
  return regularisation ? FlatCells::against(*structure_, x, regularisation->normals, threads())
                        : FlatCells::in_own_planes(*structure_, x, normals(x), threads());
}

double SurfaceWinslow::energy_of(const Coordinates& x, const Regularisation* regularisation) const {
  const FlatCells cells = lay_flat(x, regularisation);
  return sum_energy(data(cells, regularisation));
}

std::vector<double> SurfaceWinslow::determinants(const Coordinates& x, Regularisation* held) const {
  if (held) held->normals = normals(x);
  const FlatCells cells = lay_flat(x, held);
  std::vector<double> list;
  list.reserve(cells.planes.size());
  for (std::size_t t = 0; t < cells.planes.size(); ++t) list.push_back(cells.determinant(t));
  return list;
}

std::shared_ptr<const VariationalForm> SurfaceWinslow::with_corner_lengths(
    const Coordinates& x) const {
  return with_shapes(
      std::make_shared<const Targets>(winslow::with_corner_lengths(shapes(), SpacePoints(x))));
}

double SurfaceWinslow::worst(const Coordinates& x, bool of_guards) const {
  const FlatCells cells = lay_flat(x, nullptr);
  return worst_of([&](std::size_t t) { return corner_of(cells, t); }, of_guards);
}

std::vector<bool> SurfaceWinslow::turned_over(const Coordinates& x) const {
  std::vector<bool> turned;
  for (const double determinant : determinants(x, nullptr)) turned.push_back(!(determinant > 0));
  return turned;
}

bool SurfaceWinslow::turned_over(std::size_t cell, const Coordinates& coordinates) const {
  const SpacePoints x(coordinates);
  const auto& nodes = structure_->cells[cell];
  const Vec3 u = x[nodes[1]] - x[nodes[0]], v = x[nodes[2]] - x[nodes[0]];
  const Vec3 reference = node_unknowns().classes().sliding().element_normals()->of_element(
      structure_->element[cell], coordinates);
  return !(determinant_in(own_plane(u, v, reference), u, v) > 0);
}

/// Adds to `stuck` (#rows) the nodes of a cell that turn it over when moved alone from x to
/// `there`; if no single node does, all its moving nodes. y: equal to x; modified and restored.
void SurfaceWinslow::add_nodes_that_turn(std::size_t cell, const Coordinates& x,
                                         const Coordinates& there, Coordinates& y,
                                         std::vector<bool>& stuck) const {
  const NodeClasses& classes = node_unknowns().classes();
  const auto around = topology().element(structure_->element[cell]);
  for (const Index node : around)
    if (classes.slides(node)) y.set_xyz(node, classes.foot(node, x.xyz(node)).point);
  std::vector<Index> moved;
  bool found = false;
  for (const Index node : structure_->cells[cell]) {
    const Index row = structure_->row_of_node[at(node)];
    if (row < 0 || (!this->stuck().empty() && this->stuck()[at(row)])) continue;
    moved.push_back(row);
    const Vec3 stays = y.xyz(node);
    y.copy_node(node, there);
    if (turned_over(cell, y)) stuck[at(row)] = found = true;
    y.set_xyz(node, stays);
  }
  if (!found)
    for (const Index row : moved) stuck[at(row)] = true;
  for (const Index node : around) y.copy_node(node, x);
}

std::shared_ptr<const EnergyProblem> SurfaceWinslow::holding_stuck_nodes(
    const Coordinates& x, std::span<const double> direction, double step) const {
  Coordinates there = x;
  advance(direction, step, there);
  std::vector<bool> stuck = stuck_rows();
  add_nodes_led_astray(node_unknowns(), x, there, direction, 2, step, stuck);
  // Of the elements that the step turns over, the nodes that do so when moved alone.
  const std::vector<bool> before = turned_over(x), after = turned_over(there);
  Coordinates y = x;
  for (std::size_t t = 0; t < after.size(); ++t)
    if (after[t] && !before[t]) add_nodes_that_turn(t, x, there, y, stuck);
  return holding(std::move(stuck));
}

std::vector<Foot> SurfaceWinslow::feet(const Coordinates& coordinates) const {
  const SpacePoints x(coordinates);
  const auto& nodes = node_unknowns();
  std::vector<Foot> feet(nodes.nodes().size());
  constexpr Index block = 512;
  const auto find = [&](Index begin, Index end) {
    for (auto i = at(begin); i < at(end); ++i) {
      const Index node = nodes.nodes()[i];
      feet[i] = nodes.classes().foot(node, x[node]);
      if (!stuck().empty() && stuck()[i]) feet[i].frame = {};
    }
  };
  parallel_for(threads(), static_cast<Index>(feet.size()), find, block);
  return feet;
}

/// The numbers z of a cell, for each pair of its nodes.
void SurfaceWinslow::bend_out(const distortion::Corner2& corner, std::size_t cell,
                              double* z) const {
  const PenaltyFunction psi = this->psi();
  const Vec2 u(corner.ux, corner.uy), v(corner.vx, corner.vy);
  const std::array<Vec2, 3> across{v - u, -v, u};
  const std::array<double, 3> actual{across[0].dot(across[1]) / corner.d,
                                     across[0].dot(across[2]) / corner.d,
                                     across[1].dot(across[2]) / corner.d};
  std::fill_n(z, 3, 0.0);
  const Targets& targets = shapes();
  for (auto k = at(targets.offsets[cell]); k < at(targets.offsets[cell + 1]); ++k) {
    const ShapeTerm& term = targets.terms[k];
    const double f = corner.distortion(term);
    const double scale = term.weight * psi.slopes(f, targets.inverse_limit(k)).first / corner.d;
    const std::array<double, 3> target{-term.ab, -term.ac, -term.bc};
    for (std::size_t i = 0; i < 3; ++i) z[i] += scale * (target[i] - f * actual[i]);
  }
}

void SurfaceWinslow::sum_cells(const FlatCells& cells, const Regularisation* regularisation,
                               Second second, CellSums& out) const {
  const SimplexData of_cells = data(cells, regularisation);
  const PenaltyFunction psi = this->psi();
  const auto n = static_cast<Index>(cells.planes.size());
  out.bends = second == Second::exact || second == Second::projected;
  std::vector<double> energies(block_count(n), 0.0);
  static_assert(parallel_block % CellSums::lanes == 0);
  parallel_for(threads(), n, [&](Index begin, Index end) {
    energies[at(begin / parallel_block)] =
        kernel().sum(of_cells, structure_->numbers.data() + begin, end - begin, 0,
                     out.sums + Layout::sum * begin);
    for (auto t = at(begin); t < at(end); ++t) {
      if (!out.bends) continue;
      const distortion::Corner2 corner = corner_of(cells, t);
      bend_out(corner, t, out.z + 3 * t);
      if (second != Second::projected) continue;
      keep_convex(out.z + 3 * t);
      distortion::project_blocks(corner, shapes(), t, psi,
                                 out.sums + Layout::sum * static_cast<std::ptrdiff_t>(t));
    }
  });
  out.energy = std::accumulate(energies.begin(), energies.end(), 0.0);
}

namespace {

/// The directions of a node's unknowns relative to a cell: within its plane, and normal to it.
struct SeenDirections {
  SeenDirections(const CellPlane& plane, const Foot& foot) {
    for (int k = 0; k < foot.frame.count(); ++k) {
      within.col(k) = plane.of(foot.frame[k]);
      outward[k] = plane.normal.dot(foot.frame[k]);
    }
  }
  Block within = Block::Zero();
  Vec2 outward{0, 0};
};

}  // namespace

/// Computes the blocks of each cell's pairs with respect to the unknowns. feet: of the rows.
void SurfaceWinslow::find_blocks(const FlatCells& cells, std::span<const Foot> feet,
                                 CellSums& sums) const {
  const auto n = static_cast<Index>(cells.planes.size());
  parallel_for(threads(), n, [&](Index begin, Index end) {
    for (Index t = begin; t < end; ++t) {
      const auto& nodes = structure_->cells[at(t)];
      std::array<std::optional<SeenDirections>, 3> seen;
      for (std::size_t c = 0; c < 3; ++c)
        if (const Index row = structure_->row_of_node[at(nodes[c])]; row >= 0)
          seen[c].emplace(cells.planes[at(t)], feet[at(row)]);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = a + 1; b < 3; ++b) {
          if (!seen[a] || !seen[b]) continue;
          const SeenDirections &p = *seen[a], &q = *seen[b];
          Eigen::Map<Block> block(sums.blocks + 12 * at(t) + 4 * pair_of(a, b));
          block = p.within.transpose() * sums.block(t, a, b) * q.within;
          block += sums.z_of(t, a, b) * p.outward * q.outward.transpose();
        }
    }
  });
}

/// entries: values of the matrix; null where none is wanted.
SurfaceWinslow::RowSums SurfaceWinslow::sum_row(const FlatCells& cells, const CellSums& sums,
                                                const Foot& foot, Index row,
                                                double* entries) const {
  RowSums out;
  for (const Index corner : structure_->corners[row]) {
    const Index t = corner / 3;
    const std::size_t c = at(corner % 3), next = (c + 1) % 3, last = (c + 2) % 3;
    const CellPlane& plane = cells.planes[at(t)];
    const double* of_corner = sums.corner(t, c);
    out.gradient += of_corner[0] * plane.e1 + of_corner[1] * plane.e2;
    out.scale.edges += of_corner[2];
    ++out.scale.cells;
    const Block diagonal = -(sums.block(t, c, next) + sums.block(t, c, last));
    out.scale.trace += diagonal.trace();
    if (entries == nullptr) continue;
    const auto& places = structure_->entries[at(corner)];
    for (const std::size_t j : {next, last})
      if (places[j] >= 0)
        Eigen::Map<Block>(entries + std::ptrdiff_t{4} * places[j]) += sums.unknowns_block(t, c, j);
    const SeenDirections own(plane, foot);
    Eigen::Map<Block> block(entries + std::ptrdiff_t{4} * places[c]);
    block += own.within.transpose() * diagonal * own.within;
    block -=
        (sums.z_of(t, c, next) + sums.z_of(t, c, last)) * own.outward * own.outward.transpose();
  }
  return out;
}

Linearisation SurfaceWinslow::assemble(const Coordinates& x, const Regularisation* regularisation,
                                       bool projected, SparseMatrix& hessian,
                                       std::span<double> residual) const {
  const Second second = regularisation ? Second::convex
                        : projected    ? Second::projected
                                       : Second::exact;
  return assemble(x, regularisation, second, &hessian, residual);
}

Linearisation SurfaceWinslow::assemble(const Coordinates& x, const Regularisation* regularisation,
                                       Second second, SparseMatrix* hessian,
                                       std::span<double> residual) const {
  // A surface without a fixed node can move at no cost, e.g. a sphere can rotate. This share of the
  // diagonal prevents it; any other change of shape costs far more.
  constexpr double hold = 1e-8;
  const FlatCells cells = lay_flat(x, regularisation);
  CellSums sums(*structure_->memory, structure_->cells.size());
  sum_cells(cells, regularisation, second, sums);
  const std::vector<Foot> at_nodes = feet(x);
  const SparsityPattern& pattern = *structure_->pattern;
  if (hessian) {
    find_blocks(cells, at_nodes, sums);
    hessian->pattern = structure_->pattern;
    hessian->block = 2;
    hessian->symmetric = true;
    hessian->values.resize(4 * pattern.columns.size());
  }
  std::vector<NormSum> norms(block_count(pattern.rows()));
  parallel_for(threads(), pattern.rows(), [&](Index begin, Index end) {
    if (hessian)
      std::fill(hessian->values.begin() + std::ptrdiff_t{4} * pattern.offsets[at(begin)],
                hessian->values.begin() + std::ptrdiff_t{4} * pattern.offsets[at(end)], 0.0);
    for (Index row = begin; row < end; ++row) {
      const Foot& foot = at_nodes[at(row)];
      const RowSums sum =
          sum_row(cells, sums, foot, row, hessian ? hessian->values.data() : nullptr);
      Vec2 along(0, 0);
      for (int k = 0; k < foot.frame.count(); ++k) along[k] = foot.frame[k].dot(sum.gradient);
      norms[at(begin / parallel_block)].add(sum.scale.scaled(along.norm()));
      if (!residual.empty()) Eigen::Map<Vec2>(residual.data() + 2 * at(row)) = -along;
      if (!hessian) continue;
      Eigen::Map<Block> diagonal(hessian->values.data() +
                                 std::ptrdiff_t{4} * pattern.diagonal[at(row)]);
      const int count = foot.frame.count();
      const double scale = sum.scale.trace / 2;
      diagonal.topLeftCorner(count, count) +=
          bending(foot, sum.gradient, second != Second::exact).topLeftCorner(count, count);
      for (int k = count; k < 2; ++k) diagonal(k, k) = scale;
      if (structure_->loose[at(row)]) diagonal += hold * scale * Block::Identity();
      diagonal = (0.5 * (diagonal + diagonal.transpose())).eval();
    }
  });
  return {NormSum::total(norms), sums.energy};
}

ResidualNorms SurfaceWinslow::residual(const Coordinates& x, std::span<double> out) const {
  return assemble(x, nullptr, Second::none, nullptr, out).norms;
}

Coordinates SurfaceWinslow::hessian_product(const Coordinates&, const Coordinates&) const {
  throw UsageError("the boundary of a surface mesh does not move: nothing depends on it");
}

void SurfaceWinslow::velocities_transpose(const Coordinates& x, const Coordinates& forces,
                                          std::span<double>) const {
  static_cast<void>(hessian_product(x, forces));
}

void SurfaceWinslow::boundary_response(const Coordinates&, const Coordinates&,
                                       std::span<double> out) const {
  std::ranges::fill(out, 0.0);
}

}  // namespace winslow
