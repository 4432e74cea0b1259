#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/formulation/variational_winslow.h"

/// The regularised determinants of VariationalWinslow: how large they are chosen.
namespace winslow {

namespace {

double determinant(const std::array<Index, 3>& nodes, const PlanePoints& x) {
  const Vec2 u = x[nodes[1]] - x[nodes[0]];
  const Vec2 v = x[nodes[2]] - x[nodes[0]];
  return u.x() * v.y() - u.y() * v.x();
}

double determinant(const std::array<Index, 4>& nodes, const SpacePoints& x) {
  const Vec3 a = x[nodes[0]];
  return (x[nodes[1]] - a).dot((x[nodes[2]] - a).cross(x[nodes[3]] - a));
}

}  // namespace

/// Mean |determinant| of the cells around each cell's nodes.
template <int D>
std::vector<double> SimplexWinslow<D>::cell_sizes(const Coordinates& x) const {
  const auto& cells = shapes().cells;
  const Points<D> points(x);
  std::vector<double> sum(static_cast<std::size_t>(topology().node_count()), 0.0);
  std::vector<int> count(sum.size(), 0);
  for (const auto& nodes : cells) {
    const double size = std::abs(determinant(nodes, points));
    for (const Index node : nodes) {
      sum[static_cast<std::size_t>(node)] += size;
      ++count[static_cast<std::size_t>(node)];
    }
  }
  std::vector<double> sizes;
  sizes.reserve(cells.size());
  for (const auto& nodes : cells) {
    double size = 0;
    for (const Index node : nodes) {
      size += sum[static_cast<std::size_t>(node)] / count[static_cast<std::size_t>(node)];
    }
    sizes.push_back(std::max(size / (D + 1), std::numeric_limits<double>::min()));
  }
  return sizes;
}

template <int D>
Regularisation SimplexWinslow<D>::regularisation(const Coordinates& x,
                                                 std::span<const double> sizes,
                                                 double softness) const {
  const auto& cells = shapes().cells;
  const Points<D> points(x);
  Regularisation out;
  out.size.resize(cells.size());
  for (std::size_t t = 0; t < cells.size(); ++t) {
    const double negative = std::min(0.0, determinant(cells[t], points));
    out.size[t] = std::hypot(softness * sizes[t], negative);
  }
  return out;
}

template <int D>
Regularisation SimplexWinslow<D>::full_regularisation(const Coordinates& x) const {
  constexpr double far_beyond = 1e6;  // the largest determinant
  const auto& cells = shapes().cells;
  const Points<D> points(x);
  double largest = std::numeric_limits<double>::min();
  for (const auto& nodes : cells) largest = std::max(largest, std::abs(determinant(nodes, points)));
  return {std::vector<double>(cells.size(), far_beyond * largest)};
}

template std::vector<double> SimplexWinslow<2>::cell_sizes(const Coordinates&) const;
template std::vector<double> SimplexWinslow<3>::cell_sizes(const Coordinates&) const;
template Regularisation SimplexWinslow<2>::regularisation(const Coordinates&,
                                                          std::span<const double>, double) const;
template Regularisation SimplexWinslow<3>::regularisation(const Coordinates&,
                                                          std::span<const double>, double) const;
template Regularisation SimplexWinslow<2>::full_regularisation(const Coordinates&) const;
template Regularisation SimplexWinslow<3>::full_regularisation(const Coordinates&) const;

}  // namespace winslow
