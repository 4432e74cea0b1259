#include <Eigen/Geometry>

#include "core/formulation/regularisation.h"
#include "core/formulation/variational_winslow.h"

/// The regularised determinants of SimplexWinslow: how large they are chosen.
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

template <int D>
std::vector<double> determinants(const std::vector<std::array<Index, D + 1>>& cells,
                                 const Coordinates& x) {
  const Points<D> points(x);
  std::vector<double> list;
  list.reserve(cells.size());
  for (const auto& nodes : cells) list.push_back(determinant(nodes, points));
  return list;
}

}  // namespace

template <int D>
std::vector<double> SimplexWinslow<D>::cell_sizes(const Coordinates& x) const {
  const auto& cells = shapes().cells;
  return sizes_around(cells, determinants<D>(cells, x), topology().node_count());
}

template <int D>
Regularisation SimplexWinslow<D>::regularisation(const Coordinates& x,
                                                 std::span<const double> sizes,
                                                 double softness) const {
  return regularise(determinants<D>(shapes().cells, x), sizes, softness);
}

template <int D>
Regularisation SimplexWinslow<D>::full_regularisation(const Coordinates& x) const {
  return regularise_fully(determinants<D>(shapes().cells, x));
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
