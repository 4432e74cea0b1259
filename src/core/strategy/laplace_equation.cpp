#include "core/strategy/laplace_equation.h"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "core/linear/pattern_builder.h"

namespace winslow {

namespace {

/// Volume (in the plane: area) that a corner stands for, over the determinant of its edges.
double share_of_corner(ElementType type) {
  switch (type) {
    case ElementType::triangle:
      return 1.0 / 2;
    case ElementType::quadrilateral:
      return 1.0 / 4;
    case ElementType::tetrahedron:
      return 1.0 / 6;
    case ElementType::hexahedron:
      return 1.0 / 8;
    default:
      return 1.0 / 12;  // pyramid, prism
  }
}

/// The gradients of the barycentric coordinates (rows), and the determinant of the edges.
template <int D>
struct Simplex {
  std::array<Index, D + 1> nodes;
  Eigen::Matrix<double, D + 1, D> gradients;
  double size = 0;

  Simplex(const std::array<Index, D + 1>& corners, const Coordinates& x) : nodes(corners) {
    Eigen::Matrix<double, D, D> edges;
    for (int k = 0; k < D; ++k) edges.col(k) = x.get<D>(nodes[at(k + 1)]) - x.get<D>(nodes[0]);
    size = edges.determinant();
    gradients.template bottomRows<D>() = edges.inverse();
    gradients.row(0) = -gradients.template bottomRows<D>().colwise().sum();
  }
};

/// The nodes in parts of the mesh with at least one known node.
std::vector<bool> connected_to(const Topology& topology, const std::vector<bool>& known) {
  std::vector<bool> reached = known;
  std::vector<Index> ends;
  for (Index node = 0; node < topology.node_count(); ++node)
    if (known[at(node)]) ends.push_back(node);
  while (!ends.empty()) {
    const Index node = ends.back();
    ends.pop_back();
    for (const Index next : topology.neighbours(node)) {
      if (reached[at(next)]) continue;
      reached[at(next)] = true;
      ends.push_back(next);
    }
  }
  return reached;
}

}  // namespace

LaplaceEquation::LaplaceEquation(const Topology& topology, const Coordinates& x,
                                 const std::vector<bool>& known, int threads)
    : topology_(topology), x_(x), threads_(threads), numbers_(known.size(), -1) {
  const std::vector<bool> reached = connected_to(topology, known);
  for (Index node = 0; node < topology.node_count(); ++node) {
    if (known[at(node)] || !topology.used(node)) continue;
    if (!reached[at(node)]) {
      apart_.push_back(node);
      continue;
    }
    numbers_[at(node)] = static_cast<Index>(nodes_.size());
    nodes_.push_back(node);
  }
  const auto count = static_cast<Index>(nodes_.size());
  constexpr Index most_blocks = 16;  // each has a list as long as the mesh
  const Index block = std::max(parallel_block, count / most_blocks + 1);
  matrix_.pattern = build_pattern(count, block, threads_, [&] {
    return [&, seen = std::vector<Index>(nodes_.size(), -1)](Index row,
                                                             std::vector<Index>& columns) mutable {
      for (const Index e : topology_.star(nodes_[at(row)]))
        for (const Index node : topology_.element(e))
          if (const Index other = numbers_[at(node)];
              other >= 0 && std::exchange(seen[at(other)], row) != row)
            columns.push_back(other);
    };
  });
  matrix_.symmetric = true;
  matrix_.in_space = topology.cell_dimension() == 3;
  matrix_.values.resize(matrix_.pattern->columns.size());
}

/// work(begin, end) for ranges of rows, on several threads.
template <typename Work>
void LaplaceEquation::each_row(const Work& work) const {
  constexpr Index most_blocks = 16;
  const auto count = static_cast<Index>(nodes_.size());
  parallel_for(threads_, count, work, std::max(parallel_block, count / most_blocks + 1));
}

/// visit(simplex, volume) for the corner simplices of an element that are not inverted.
template <int D, typename Visit>
void LaplaceEquation::visit_simplices(Index e, const Visit& visit) const {
  const auto element = topology_.element(e);
  const ElementType type = topology_.element_type(e);
  const auto visit_corner = [&](const std::array<Index, D + 1>& corners) {
    const Simplex<D> simplex(corners, x_);
    if (simplex.size > 0) visit(simplex, share_of_corner(type) * simplex.size);
  };
  if constexpr (D == 3) {
    for (const auto& corner : corner_tetrahedra(type)) visit_corner(by_nodes(corner, element));
  } else {
    const std::size_t n = element.size();
    for (std::size_t k = 0; k < (n == 3 ? 1 : n); ++k)
      visit_corner({element[k], element[(k + 1) % n], element[(k + n - 1) % n]});
  }
}

template <int D>
void LaplaceEquation::assemble_in(const std::vector<std::vector<double>>& fields) {
  const SparsityPattern& pattern = *matrix_.pattern;
  right_hand_sides_.assign(fields.size(), std::vector<double>(nodes_.size(), 0.0));
  each_row([&](Index begin, Index end) {
    std::vector<Index> entry(nodes_.size());  // of the present row at its columns
    for (Index row = begin; row < end; ++row) {
      for (Index e = pattern.offsets[at(row)]; e < pattern.offsets[at(row) + 1]; ++e) {
        entry[at(pattern.columns[at(e)])] = e;
        matrix_.values[at(e)] = 0;
      }
      const Index own_node = nodes_[at(row)];
      for (const Index element : topology_.star(own_node)) {
        const double conductivity = conductivity_.empty() ? 1 : conductivity_[at(element)];
        visit_simplices<D>(element, [&](const Simplex<D>& simplex, double volume) {
          const auto found = std::ranges::find(simplex.nodes, own_node);
          if (found == simplex.nodes.end()) return;
          const auto own = static_cast<int>(found - simplex.nodes.begin());
          for (int k = 0; k <= D; ++k) {
            const double value =
                conductivity * volume * simplex.gradients.row(own).dot(simplex.gradients.row(k));
            const Index node = simplex.nodes[at(k)];
            if (const Index column = numbers_[at(node)]; column >= 0) {
              matrix_.values[at(entry[at(column)])] += value;
              continue;
            }
            for (std::size_t f = 0; f < fields.size(); ++f)
              right_hand_sides_[f][at(row)] -= value * fields[f][at(node)];
          }
        });
      }
    }
  });
  // Rows add their entries in different orders: copies the lower triangle.
  each_row([&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row)
      for (Index e = pattern.diagonal[at(row)] + 1; e < pattern.offsets[at(row) + 1]; ++e)
        matrix_.values[at(e)] = matrix_.values[at(pattern.find(pattern.columns[at(e)], row))];
  });
}

/// For the present values of the fields, averaged geometrically with the conductivity before.
template <int D>
void LaplaceEquation::update_conductivity_in(const std::vector<std::vector<double>>& fields,
                                             double exponent) {
  constexpr double least = 1e-3;  // share of the largest gradient
  const Index count = topology_.element_count();
  std::vector<double> steepness(at(count));
  std::vector<double> largest(block_count(count), 0.0);
  parallel_for(threads_, count, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      double sum = 0, total = 0;
      visit_simplices<D>(e, [&](const Simplex<D>& simplex, double volume) {
        total += volume;
        for (const auto& field : fields) {
          Eigen::Matrix<double, 1, D> gradient = Eigen::Matrix<double, 1, D>::Zero();
          for (int k = 0; k <= D; ++k)
            gradient += field[at(simplex.nodes[at(k)])] * simplex.gradients.row(k);
          sum += volume * gradient.squaredNorm();
        }
      });
      steepness[at(e)] = total > 0 ? std::sqrt(sum / total) : 0;
      largest[at(begin / parallel_block)] =
          std::max(largest[at(begin / parallel_block)], steepness[at(e)]);
    }
  });
  const double most = largest.empty() ? 0 : *std::ranges::max_element(largest);
  if (!(most > 0)) return;
  const bool first = conductivity_.empty();
  conductivity_.resize(at(count), 1);
  parallel_for(threads_, count, [&](Index begin, Index end) {
    for (auto e = at(begin); e < at(end); ++e) {
      const double now = std::pow(steepness[e] / most + least, exponent - 2);
      conductivity_[e] = first ? now : std::sqrt(conductivity_[e] * now);
    }
  });
}

void LaplaceEquation::assemble(const std::vector<std::vector<double>>& fields) {
  topology_.cell_dimension() == 3 ? assemble_in<3>(fields) : assemble_in<2>(fields);
}

void LaplaceEquation::solve_assembled(double accuracy, std::vector<std::vector<double>>& fields) {
  if (!solver_) solver_ = make_linear_solver({}, threads_);
  solver_->set_tolerance(accuracy);
  solver_->set_matrix(matrix_);
  std::vector<double> solution(nodes_.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for (std::size_t i = 0; i < solution.size(); ++i) solution[i] = fields[f][at(nodes_[i])];
    solver_->solve(right_hand_sides_[f], 1, solution);
    for (std::size_t i = 0; i < solution.size(); ++i) fields[f][at(nodes_[i])] = solution[i];
  }
}

void LaplaceEquation::solve(const Options& options, std::vector<std::vector<double>>& fields) {
  constexpr int updates = 2;
  constexpr double loose = 1e-2;  // accuracy of fields that only give a conductivity
  conductivity_.clear();
  for (auto& field : fields)
    for (const Index node : apart_) field[at(node)] = 0;
  if (nodes_.empty()) return;
  assemble(fields);
  for (int i = 0; i < updates && options.exponent > 2; ++i) {
    solve_assembled(std::max(loose, options.accuracy), fields);
    topology_.cell_dimension() == 3 ? update_conductivity_in<3>(fields, options.exponent)
                                    : update_conductivity_in<2>(fields, options.exponent);
    assemble(fields);
  }
  solve_assembled(options.accuracy, fields);
}

}  // namespace winslow
