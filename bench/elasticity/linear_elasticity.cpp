#include "elasticity/linear_elasticity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/search/box_tree.h"

namespace winslow::bench {

namespace {

/// Gradients of the shape functions of an element at a point of integration, and the point's share
/// of the area or volume.
template <int D>
struct GaussPoint {
  std::array<Vec<D>, 4> gradients;
  double measure = 0;

  GaussPoint() { gradients.fill(Vec<D>::Zero()); }
};

GaussPoint<2> triangle_point(std::span<const Vec2> p) {
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  const double twice = cross(p[1] - p[0], p[2] - p[0]);
  GaussPoint<2> point;
  point.measure = 0.5 * twice;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 opposite = p[(k + 2) % 3] - p[(k + 1) % 3];
    point.gradients[k] = Vec2(-opposite.y(), opposite.x()) / twice;
  }
  return point;
}

/// At (xi, eta) of the bilinear map from the square [-1, 1]^2; the weight there is 1.
GaussPoint<2> quadrilateral_point(std::span<const Vec2> p, double xi, double eta) {
  constexpr std::array<std::array<double, 2>, 4> sign{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  std::array<Vec2, 4> local;
  Vec2 by_xi(0, 0), by_eta(0, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    local[k] = 0.25 * Vec2(sign[k][0] * (1 + sign[k][1] * eta), sign[k][1] * (1 + sign[k][0] * xi));
    by_xi += local[k].x() * p[k];
    by_eta += local[k].y() * p[k];
  }
  GaussPoint<2> point;
  point.measure = by_xi.x() * by_eta.y() - by_xi.y() * by_eta.x();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 l = local[k];
    point.gradients[k] =
        Vec2(by_eta.y() * l.x() - by_xi.y() * l.y(), by_xi.x() * l.y() - by_eta.x() * l.x()) /
        point.measure;
  }
  return point;
}

std::vector<GaussPoint<2>> gauss_points(std::span<const Vec2> corners) {
  if (corners.size() == 3) return {triangle_point(corners)};
  const double g = 1 / std::sqrt(3.0);
  return {quadrilateral_point(corners, -g, -g), quadrilateral_point(corners, g, -g),
          quadrilateral_point(corners, g, g), quadrilateral_point(corners, -g, g)};
}

std::vector<GaussPoint<3>> gauss_points(std::span<const Vec3> p) {
  GaussPoint<3> point;
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const double six = a.dot(b.cross(c));
  point.measure = six / 6;
  point.gradients[1] = b.cross(c) / six;
  point.gradients[2] = c.cross(a) / six;
  point.gradients[3] = a.cross(b) / six;
  point.gradients[0] = -point.gradients[1] - point.gradients[2] - point.gradients[3];
  return {point};
}

double measure_of(std::span<const Vec2> p) {
  double twice = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Vec2 &a = p[k], &b = p[(k + 1) % p.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

double measure_of(std::span<const Vec3> p) {
  return (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0])) / 6;
}

struct Lame {
  double lambda = 0, mu = 0;
  Lame(double modulus, double poisson_ratio)
      : lambda(modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))),
        mu(modulus / (2 * (1 + poisson_ratio))) {}
};

template <int D>
std::vector<double> stiffness_of(std::span<const Vec<D>> corners, double modulus,
                                 double poisson_ratio) {
  constexpr auto d = static_cast<std::size_t>(D);
  const std::size_t n = corners.size();
  const Lame lame(modulus, poisson_ratio);
  std::vector<double> k(d * d * n * n, 0.0);
  for (const GaussPoint<D>& point : gauss_points(corners)) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const Vec<D>&a = point.gradients[i], &b = point.gradients[j];
        const double common = lame.mu * a.dot(b);
        for (int r = 0; r < D; ++r) {
          for (int c = 0; c < D; ++c) {
            const double value =
                lame.lambda * a[r] * b[c] + lame.mu * a[c] * b[r] + (r == c ? common : 0.0);
            k[(d * i + static_cast<std::size_t>(r)) * d * n + d * j +
              static_cast<std::size_t>(c)] += point.measure * value;
          }
        }
      }
    }
  }
  return k;
}

template <int D>
double energy_of(std::span<const Vec<D>> corners, std::span<const Vec<D>> displacements,
                 double modulus, double poisson_ratio) {
  const Lame lame(modulus, poisson_ratio);
  double energy = 0;
  for (const GaussPoint<D>& point : gauss_points(corners)) {
    Eigen::Matrix<double, D, D> gradient = Eigen::Matrix<double, D, D>::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i)
      gradient += displacements[i] * point.gradients[i].transpose();
    const Eigen::Matrix<double, D, D> strain = 0.5 * (gradient + gradient.transpose());
    const double trace = strain.trace();
    energy +=
        0.5 * point.measure * (lame.lambda * trace * trace + 2 * lame.mu * strain.squaredNorm());
  }
  return energy;
}

}  // namespace

std::vector<double> element_stiffness(std::span<const Vec2> corners, double modulus,
                                      double poisson_ratio) {
  return stiffness_of<2>(corners, modulus, poisson_ratio);
}

std::vector<double> element_stiffness(std::span<const Vec3> corners, double modulus,
                                      double poisson_ratio) {
  return stiffness_of<3>(corners, modulus, poisson_ratio);
}

double strain_energy(std::span<const Vec2> corners, std::span<const Vec2> displacements,
                     double modulus, double poisson_ratio) {
  return energy_of<2>(corners, displacements, modulus, poisson_ratio);
}

double strain_energy(std::span<const Vec3> corners, std::span<const Vec3> displacements,
                     double modulus, double poisson_ratio) {
  return energy_of<3>(corners, displacements, modulus, poisson_ratio);
}

template <int D>
ElasticSolid<D>::ElasticSolid(std::shared_ptr<const Topology> topology, std::vector<Index> walls,
                              const ElasticityOptions& options)
    : topology_(std::move(topology)), walls_(std::move(walls)), options_(options) {
  if constexpr (D == 3) {
    for (Index e = 0; e < topology_->element_count(); ++e) {
      if (topology_->element_type(e) != ElementType::tetrahedron)
        throw UsageError("elasticity in space: element " + std::to_string(e) +
                         " is no tetrahedron");
    }
    solver_ = make_linear_solver(
        {.solver = "multigrid", .tolerance = options.tolerance, .max_iterations = 2000},
        options.threads);
  } else {
    factors_ = make_cholesky();
  }
  make_pattern();
}

/// Interior nodes that share an element.
template <int D>
void ElasticSolid<D>::make_pattern() {
  unknown_.assign(static_cast<std::size_t>(topology_->node_count()), -1);
  Index count = 0;
  for (const Index node : topology_->interior_nodes()) {
    unknown_[static_cast<std::size_t>(node)] = count++;
  }
  auto pattern = std::make_shared<SparsityPattern>();
  for (const Index node : topology_->interior_nodes()) {
    std::set<Index> row;
    for (const Index e : topology_->star(node)) {
      for (const Index other : topology_->element(e)) {
        const Index place = unknown_[static_cast<std::size_t>(other)];
        if (place >= 0) row.insert(place);
      }
    }
    for (const Index column : row) {
      if (column == unknown_[static_cast<std::size_t>(node)]) {
        pattern->diagonal.push_back(static_cast<Index>(pattern->columns.size()));
      }
      pattern->columns.push_back(column);
    }
    pattern->offsets.push_back(static_cast<Index>(pattern->columns.size()));
  }
  const auto entry_of = [&](Index row, Index column) {
    if (row < 0 || column < 0) return Index{-1};
    const auto begin = pattern->columns.begin() + pattern->offsets[static_cast<std::size_t>(row)];
    const auto end = pattern->columns.begin() + pattern->offsets[static_cast<std::size_t>(row) + 1];
    return static_cast<Index>(std::lower_bound(begin, end, column) - pattern->columns.begin());
  };
  for (Index e = 0; e < topology_->element_count(); ++e) {
    for (const Index i : topology_->element(e))
      for (const Index j : topology_->element(e))
        entries_.push_back(
            entry_of(unknown_[static_cast<std::size_t>(i)], unknown_[static_cast<std::size_t>(j)]));
  }
  matrix_.pattern = std::move(pattern);
  matrix_.block = D;
  matrix_.symmetric = true;
}

template <int D>
std::vector<double> ElasticSolid<D>::moduli(const Coordinates& x) const {
  std::vector<double> distance(static_cast<std::size_t>(topology_->node_count()), 0.0);
  if (options_.modulus == Modulus::wall_distance) {
    std::vector<Vec<D>> points;
    for (const Index node : walls_) points.push_back(x.get<D>(node));
    const BoxTree<D> tree{std::span<const Vec<D>>(points)};
    for (Index i = 0; i < topology_->node_count(); ++i) {
      const auto nearest = tree.nearest(x.get<D>(i), std::numeric_limits<double>::infinity());
      distance[static_cast<std::size_t>(i)] = nearest->distance;
    }
  }
  std::vector<double> moduli;
  std::vector<Vec<D>> corners;
  for (Index e = 0; e < topology_->element_count(); ++e) {
    const auto nodes = topology_->element(e);
    corners.clear();
    double sum = 0;
    for (const Index node : nodes) {
      corners.push_back(x.get<D>(node));
      sum += distance[static_cast<std::size_t>(node)];
    }
    switch (options_.modulus) {
      case Modulus::wall_distance:
        moduli.push_back(static_cast<double>(nodes.size()) / sum);
        break;
      case Modulus::volume:
        moduli.push_back(1 / std::abs(measure_of(corners)));
        break;
      case Modulus::constant:
        moduli.push_back(1);
        break;
    }
  }
  return moduli;
}

template <int D>
void ElasticSolid<D>::assemble(const Coordinates& x, const Coordinates& boundary) {
  constexpr auto d = static_cast<std::size_t>(D);
  matrix_.values.assign(d * d * matrix_.pattern->columns.size(), 0.0);
  rhs_.assign(static_cast<std::size_t>(matrix_.rows()), 0.0);
  const std::vector<double> modulus = moduli(x);
  std::vector<Vec<D>> corners;
  std::size_t entry = 0;
  for (Index e = 0; e < topology_->element_count(); ++e) {
    corners.clear();
    for (const Index node : topology_->element(e)) corners.push_back(x.get<D>(node));
    add_element(
        e, entry,
        element_stiffness(corners, modulus[static_cast<std::size_t>(e)], options_.poisson_ratio), x,
        boundary);
    entry += corners.size() * corners.size();
  }
}

/// entry: of entries_, where those of the element begin.
template <int D>
void ElasticSolid<D>::add_element(Index e, std::size_t entry, const std::vector<double>& stiffness,
                                  const Coordinates& x, const Coordinates& boundary) {
  constexpr auto d = static_cast<std::size_t>(D);
  const auto nodes = topology_->element(e);
  const std::size_t n = nodes.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Index row = unknown_[static_cast<std::size_t>(nodes[i])];
    if (row < 0) continue;
    for (std::size_t j = 0; j < n; ++j) {
      const Index to = entries_[entry + i * n + j];
      const Vec<D> given = boundary.get<D>(nodes[j]) - x.get<D>(nodes[j]);
      for (std::size_t r = 0; r < d; ++r) {
        for (std::size_t c = 0; c < d; ++c) {
          const double value = stiffness[(d * i + r) * d * n + d * j + c];
          if (to >= 0) {
            matrix_.values[(static_cast<std::size_t>(to) * d + r) * d + c] += value;
          } else {
            rhs_[d * static_cast<std::size_t>(row) + r] -= value * given[static_cast<int>(c)];
          }
        }
      }
    }
  }
}

template <int D>
void ElasticSolid<D>::solve(std::vector<double>& u) {
  if constexpr (D == 2) {
    factors_->factorise(matrix_);
    factors_->solve(rhs_, 1, u);
  } else {
    solver_->set_matrix(matrix_);
    const LinearResult result = solver_->solve(rhs_, 1, u);
    linear_iterations_ += result.iterations;
    if (!(result.relative_residual <= 10 * options_.tolerance))
      throw NumericError("elasticity: the linear solver stopped at a residual of " +
                         std::to_string(result.relative_residual));
  }
}

template <int D>
void ElasticSolid<D>::deform(Coordinates& x, const Coordinates& boundary) {
  assemble(x, boundary);
  std::vector<double> u(rhs_.size());
  solve(u);
  for (Index i = 0; i < topology_->node_count(); ++i) {
    const Index place = unknown_[static_cast<std::size_t>(i)];
    if (place < 0) {
      x.copy_node(i, boundary);
    } else {
      const Vec<D> moved = x.get<D>(i) + Vec<D>(u.data() + D * static_cast<std::ptrdiff_t>(place));
      x.set<D>(i, moved);
    }
  }
}

template class ElasticSolid<2>;
template class ElasticSolid<3>;

}  // namespace winslow::bench
