#include "elasticity/linear_elasticity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/search/box_tree.h"

namespace winslow::bench {

namespace {

/// Gradients of the shape functions of an element at a point of integration, and the point's share
/// of the area.
struct GaussPoint {
  std::array<Vec2, 4> gradients{Vec2(0, 0), Vec2(0, 0), Vec2(0, 0), Vec2(0, 0)};
  double area = 0;
};

GaussPoint triangle_point(std::span<const Vec2> p) {
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  const double twice = cross(p[1] - p[0], p[2] - p[0]);
  GaussPoint point;
  point.area = 0.5 * twice;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 opposite = p[(k + 2) % 3] - p[(k + 1) % 3];
    point.gradients[k] = Vec2(-opposite.y(), opposite.x()) / twice;
  }
  return point;
}

/// At (xi, eta) of the bilinear map from the square [-1, 1]^2; the weight there is 1.
GaussPoint quadrilateral_point(std::span<const Vec2> p, double xi, double eta) {
  constexpr std::array<std::array<double, 2>, 4> sign{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  std::array<Vec2, 4> local;
  Vec2 by_xi(0, 0), by_eta(0, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    local[k] = 0.25 * Vec2(sign[k][0] * (1 + sign[k][1] * eta), sign[k][1] * (1 + sign[k][0] * xi));
    by_xi += local[k].x() * p[k];
    by_eta += local[k].y() * p[k];
  }
  GaussPoint point;
  point.area = by_xi.x() * by_eta.y() - by_xi.y() * by_eta.x();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 l = local[k];
    point.gradients[k] =
        Vec2(by_eta.y() * l.x() - by_xi.y() * l.y(), by_xi.x() * l.y() - by_eta.x() * l.x()) /
        point.area;
  }
  return point;
}

std::vector<GaussPoint> gauss_points(std::span<const Vec2> corners) {
  if (corners.size() == 3) return {triangle_point(corners)};
  const double g = 1 / std::sqrt(3.0);
  return {quadrilateral_point(corners, -g, -g), quadrilateral_point(corners, g, -g),
          quadrilateral_point(corners, g, g), quadrilateral_point(corners, -g, g)};
}

struct Lame {
  double lambda = 0, mu = 0;
  Lame(double modulus, double poisson_ratio)
      : lambda(modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))),
        mu(modulus / (2 * (1 + poisson_ratio))) {}
};

}  // namespace

std::vector<double> element_stiffness(std::span<const Vec2> corners, double modulus,
                                      double poisson_ratio) {
  const std::size_t n = corners.size();
  const Lame lame(modulus, poisson_ratio);
  std::vector<double> k(4 * n * n, 0.0);
  for (const GaussPoint& point : gauss_points(corners)) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const Vec2 a = point.gradients[i], b = point.gradients[j];
        const double common = lame.mu * a.dot(b);
        for (int r = 0; r < 2; ++r) {
          for (int c = 0; c < 2; ++c) {
            const double value =
                lame.lambda * a[r] * b[c] + lame.mu * a[c] * b[r] + (r == c ? common : 0.0);
            k[(2 * i + static_cast<std::size_t>(r)) * 2 * n + 2 * j +
              static_cast<std::size_t>(c)] += point.area * value;
          }
        }
      }
    }
  }
  return k;
}

double strain_energy(std::span<const Vec2> corners, std::span<const Vec2> displacements,
                     double modulus, double poisson_ratio) {
  const Lame lame(modulus, poisson_ratio);
  double energy = 0;
  for (const GaussPoint& point : gauss_points(corners)) {
    double xx = 0, yy = 0, xy = 0;  // strain
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 u = displacements[i], g = point.gradients[i];
      xx += u.x() * g.x();
      yy += u.y() * g.y();
      xy += 0.5 * (u.x() * g.y() + u.y() * g.x());
    }
    const double trace = xx + yy;
    energy += 0.5 * point.area *
              (lame.lambda * trace * trace + 2 * lame.mu * (xx * xx + yy * yy + 2 * xy * xy));
  }
  return energy;
}

ElasticSolid::ElasticSolid(std::shared_ptr<const Topology> topology, std::vector<Index> walls,
                           const ElasticityOptions& options)
    : topology_(std::move(topology)), walls_(std::move(walls)), options_(options) {
  make_pattern();
}

/// Interior nodes that share an element.
void ElasticSolid::make_pattern() {
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
  matrix_.pattern = std::move(pattern);
  matrix_.block = 2;
  matrix_.symmetric = true;
}

std::vector<double> ElasticSolid::moduli(const Coordinates& x) const {
  std::vector<double> distance(static_cast<std::size_t>(topology_->node_count()), 0.0);
  if (options_.modulus == Modulus::wall_distance) {
    std::vector<Vec2> points;
    for (const Index node : walls_) points.push_back(x.xy(node));
    const BoxTree<2> tree{std::span<const Vec2>(points)};
    for (Index i = 0; i < topology_->node_count(); ++i) {
      const auto nearest = tree.nearest(x.xy(i), std::numeric_limits<double>::infinity());
      distance[static_cast<std::size_t>(i)] = nearest->distance;
    }
  }
  std::vector<double> moduli;
  for (Index e = 0; e < topology_->element_count(); ++e) {
    const auto nodes = topology_->element(e);
    double sum = 0, twice_area = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vec2 a = x.xy(nodes[k]), b = x.xy(nodes[(k + 1) % nodes.size()]);
      sum += distance[static_cast<std::size_t>(nodes[k])];
      twice_area += a.x() * b.y() - a.y() * b.x();
    }
    switch (options_.modulus) {
      case Modulus::wall_distance:
        moduli.push_back(static_cast<double>(nodes.size()) / sum);
        break;
      case Modulus::volume:
        moduli.push_back(2 / std::abs(twice_area));
        break;
      case Modulus::constant:
        moduli.push_back(1);
        break;
    }
  }
  return moduli;
}

void ElasticSolid::assemble(const Coordinates& x, const Coordinates& boundary) {
  const SparsityPattern& pattern = *matrix_.pattern;
  matrix_.values.assign(4 * pattern.columns.size(), 0.0);
  rhs_.assign(static_cast<std::size_t>(matrix_.rows()), 0.0);
  const std::vector<double> modulus = moduli(x);
  std::vector<Vec2> corners;
  for (Index e = 0; e < topology_->element_count(); ++e) {
    const auto nodes = topology_->element(e);
    corners.clear();
    for (const Index node : nodes) corners.push_back(x.xy(node));
    const std::size_t n = nodes.size();
    const auto k =
        element_stiffness(corners, modulus[static_cast<std::size_t>(e)], options_.poisson_ratio);
    for (std::size_t i = 0; i < n; ++i) {
      const Index row = unknown_[static_cast<std::size_t>(nodes[i])];
      if (row < 0) continue;
      const auto begin = pattern.columns.begin() + pattern.offsets[static_cast<std::size_t>(row)];
      const auto end = pattern.columns.begin() + pattern.offsets[static_cast<std::size_t>(row) + 1];
      for (std::size_t j = 0; j < n; ++j) {
        const Index column = unknown_[static_cast<std::size_t>(nodes[j])];
        const Vec2 given = boundary.xy(nodes[j]) - x.xy(nodes[j]);
        const auto entry = static_cast<std::size_t>(
            column < 0 ? 0 : std::lower_bound(begin, end, column) - pattern.columns.begin());
        for (std::size_t r = 0; r < 2; ++r) {
          for (std::size_t c = 0; c < 2; ++c) {
            const double value = k[(2 * i + r) * 2 * n + 2 * j + c];
            if (column >= 0) {
              matrix_.values[(entry * 2 + r) * 2 + c] += value;
            } else {
              rhs_[2 * static_cast<std::size_t>(row) + r] -= value * given[static_cast<int>(c)];
            }
          }
        }
      }
    }
  }
}

void ElasticSolid::deform(Coordinates& x, const Coordinates& boundary) {
  assemble(x, boundary);
  factors_->factorise(matrix_);
  std::vector<double> u(rhs_.size());
  factors_->solve(rhs_, 1, u);
  for (Index i = 0; i < topology_->node_count(); ++i) {
    const Index place = unknown_[static_cast<std::size_t>(i)];
    if (place < 0) {
      x.set_xy(i, boundary.xy(i));
    } else {
      const auto first = 2 * static_cast<std::size_t>(place);
      x.set_xy(i, x.xy(i) + Vec2(u[first], u[first + 1]));
    }
  }
}

void deform_in_increments(ElasticSolid& solid, const BoundaryMotion& motion, int increments,
                          Coordinates& x) {
  for (int k = 1; k <= increments; ++k) {
    Coordinates boundary = x;
    motion(static_cast<double>(k) / increments, boundary);
    solid.deform(x, boundary);
  }
}

}  // namespace winslow::bench
