#include "core/strategy/laplace_equation.h"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "core/linear/pattern_builder.h"

namespace winslow {

namespace {

/// Volume (in the plane: area) that a corner stands for, over the determinant of its edges.
double share_of_corner(const ElementShape& shape) {
  switch (shape.like) {
    case ElementType::triangle:
    case ElementType::polygon:  // cut into triangles
      return 1.0 / 2;
    case ElementType::quadrilateral:
      return 1.0 / 4;
    case ElementType::tetrahedron:
      return 1.0 / 6;
    case ElementType::hexahedron:
      return 1.0 / 8;
    case ElementType::polyhedron:
      return 1.0 / static_cast<double>(std::max<std::size_t>(1, shape.corner_tetrahedra.size()));
    default:
      return 1.0 / 12;  // pyramid, prism
  }
}

/// The gradients of the barycentric coordinates (rows), and the determinant of the edges.
template <int D>
struct Simplex {
  std::array<std::size_t, D + 1> corners;  // of the element
  Eigen::Matrix<double, D + 1, D> gradients;
  double size = 0;

  template <typename Corner>
  Simplex(const std::array<Corner, D + 1>& of_element, std::span<const Index> nodes,
          const Coordinates& x) {
    for (std::size_t k = 0; k <= D; ++k) corners[k] = static_cast<std::size_t>(of_element[k]);
    const auto place = [&](int k) { return x.get<D>(nodes[corners[at(k)]]); };
    Eigen::Matrix<double, D, D> edges;
    for (int k = 0; k < D; ++k) edges.col(k) = place(k + 1) - place(0);
    size = edges.determinant();
    gradients.template bottomRows<D>() = edges.inverse();
    gradients.row(0) = -gradients.template bottomRows<D>().colwise().sum();
  }
};

/// The number of a pair of nodes of an element, i < j.
std::size_t pair_of(std::size_t i, std::size_t j) { return j * (j - 1) / 2 + i; }

/// Calls visit(simplex, volume) for the corner simplices of an element that are not inverted.
template <int D, typename Visit>
void visit_simplices(const Topology& topology, const Coordinates& x, Index e, const Visit& visit) {
  const std::size_t n = topology.element(e).size();
  const ElementShape& shape = topology.shape(e);
  const auto visit_corner = [&](const auto& corners) {
    const Simplex<D> simplex(corners, topology.element(e), x);
    if (simplex.size > 0) visit(simplex, share_of_corner(shape) * simplex.size);
  };
  if constexpr (D == 3) {
    for (const auto& corner : shape.corner_tetrahedra) visit_corner(corner);
  } else if (shape.type == ElementType::polygon) {
    for (const auto& triangle : cut_polygon(places_of(x, topology.element(e))))
      visit_corner(triangle);
  } else {
    for (std::size_t k = 0; k < (n == 3 ? 1 : n); ++k)
      visit_corner(std::array<std::size_t, 3>{k, (k + 1) % n, (k + n - 1) % n});
  }
}

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
  matrix_.pattern = build_pattern(count, few_blocks(count), threads_, [&] {
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

/// Calls work(begin, end) for ranges of rows, on several threads.
template <typename Work>
void LaplaceEquation::each_row(const Work& work) const {
  const auto count = static_cast<Index>(nodes_.size());
  parallel_for(threads_, count, work, few_blocks(count));
}

/// The matrices of the elements for a conductivity of 1, and their volumes.
template <int D>
void LaplaceEquation::make_elements() {
  const Index count = topology_.element_count();
  elements_.first_pair.assign(at(count) + 1, 0);
  for (Index e = 0; e < count; ++e)
    elements_.first_pair[at(e) + 1] =
        elements_.first_pair[at(e)] + pair_of(0, topology_.element(e).size());
  elements_.of_pair.assign(elements_.first_pair.back(), 0);
  elements_.volume.assign(at(count), 0);
  parallel_for(threads_, count, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      double* of_pair = &elements_.of_pair[elements_.first_pair[at(e)]];
      visit_simplices<D>(topology_, x_, e, [&](const Simplex<D>& simplex, double volume) {
        elements_.volume[at(e)] += volume;
        for (int j = 0; j <= D; ++j) {
          for (int i = 0; i <= D; ++i) {
            const std::size_t a = simplex.corners[at(i)], b = simplex.corners[at(j)];
            if (a < b)
              of_pair[pair_of(a, b)] +=
                  volume * simplex.gradients.row(i).dot(simplex.gradients.row(j));
          }
        }
      });
    }
  });
}

void LaplaceEquation::assemble(const std::vector<std::vector<double>>& fields) {
  const SparsityPattern& pattern = *matrix_.pattern;
  right_hand_sides_.assign(fields.size(), std::vector<double>(nodes_.size(), 0.0));
  each_row([&](Index begin, Index end) {
    std::vector<Index> entry(nodes_.size());  // of the present row at its columns
    for (Index row = begin; row < end; ++row) {
      for (Index e = pattern.offsets[at(row)]; e < pattern.offsets[at(row) + 1]; ++e) {
        entry[at(pattern.columns[at(e)])] = e;
        matrix_.values[at(e)] = 0;
      }
      double& diagonal = matrix_.values[at(pattern.diagonal[at(row)])];
      for (const Index element : topology_.star(nodes_[at(row)])) {
        const double conductivity = conductivity_.empty() ? 1 : conductivity_[at(element)];
        const double* of_pair = &elements_.of_pair[elements_.first_pair[at(element)]];
        const auto corners = topology_.element(element);
        const auto own =
            static_cast<std::size_t>(std::ranges::find(corners, nodes_[at(row)]) - corners.begin());
        for (std::size_t k = 0; k < corners.size(); ++k) {
          if (k == own) continue;
          const double value = conductivity * of_pair[pair_of(std::min(k, own), std::max(k, own))];
          diagonal -= value;
          if (const Index column = numbers_[at(corners[k])]; column >= 0) {
            matrix_.values[at(entry[at(column)])] += value;
            continue;
          }
          for (std::size_t f = 0; f < fields.size(); ++f)
            right_hand_sides_[f][at(row)] -= value * fields[f][at(corners[k])];
        }
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
void LaplaceEquation::update_conductivity(const std::vector<std::vector<double>>& fields,
                                          double exponent) {
  constexpr double least = 1e-3;  // share of the largest gradient
  const Index count = topology_.element_count();
  std::vector<double> steepness(at(count));
  std::vector<double> largest(block_count(count), 0.0);
  parallel_for(threads_, count, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const auto corners = topology_.element(e);
      double sum = 0;  // of the squared gradients over the volume
      for (const auto& field : fields) {
        const double* of_pair = &elements_.of_pair[elements_.first_pair[at(e)]];
        for (std::size_t j = 1; j < corners.size(); ++j)
          for (std::size_t i = 0; i < j; ++i)
            sum -= *of_pair++ * std::pow(field[at(corners[i])] - field[at(corners[j])], 2);
      }
      steepness[at(e)] = sum > 0 ? std::sqrt(sum / elements_.volume[at(e)]) : 0;
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
  topology_.cell_dimension() == 3 ? make_elements<3>() : make_elements<2>();
  assemble(fields);
  for (int i = 0; i < updates && options.exponent > 2; ++i) {
    solve_assembled(std::max(loose, options.accuracy), fields);
    update_conductivity(fields, options.exponent);
    assemble(fields);
  }
  elements_ = {};
  solve_assembled(options.accuracy, fields);
}

}  // namespace winslow
