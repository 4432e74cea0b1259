#include "core/formulation/corner_lengths.h"

#include <array>
#include <cmath>

#include "core/formulation/volume_metric.h"

namespace winslow {

namespace {

/// Share of a metric's larger entries below which an entry is round-off: a right angle.
constexpr double round_off = 1e-9;

template <int D>
using Lengths = std::array<double, at(D)>;  // of the edges from a cell's first node

/// S: dimension of the space.
template <int S, std::size_t N>
std::array<double, N - 1> lengths_at(const Points<S>& x, const std::array<Index, N>& cell) {
  std::array<double, N - 1> lengths;
  for (std::size_t k = 1; k < N; ++k) lengths[k - 1] = (x[cell[k]] - x[cell[0]]).norm();
  return lengths;
}

void take_lengths(ShapeTerm& term, const Lengths<2>& lengths) {
  if (!(std::abs(term.bc) <= round_off * (term.ab + term.ac))) return;
  const double ratio = lengths[1] / lengths[0];
  term.ab = ratio;
  term.ac = 1 / ratio;
  term.bc = 0;
}

void take_lengths(VolumeTerm& term, const Lengths<3>& lengths) {
  const Eigen::Matrix3d metric = metric_of(term);
  const auto right = [&](int k, int l) {
    return std::abs(metric(k, l)) <= round_off * std::sqrt(metric(k, k) * metric(l, l));
  };
  const Eigen::Matrix3d gram = metric.inverse();
  Vec3 scale;
  for (int k = 0; k < 3; ++k) scale[k] = lengths[at(k)] / std::sqrt(gram(k, k));
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    if (!right(k, l) || !right(k, m)) continue;
    if (!right(l, m)) scale[l] = scale[m] = std::sqrt(scale[l] * scale[m]);
    const Vec3 inverse = scale.cwiseInverse();
    const Eigen::Matrix3d scaled = inverse.asDiagonal() * metric * inverse.asDiagonal();
    term = volume_term(normalized_metric(scaled), term.weight);
    return;
  }
}

template <int S, int D>
void take_lengths(CellTargets<D>& targets, const Points<S>& x) {
  for (std::size_t t = 0; t < targets.cells.size(); ++t) {
    const Lengths<D> lengths = lengths_at(x, targets.cells[t]);
    for (Index k = targets.offsets[t]; k < targets.offsets[t + 1]; ++k)
      take_lengths(targets.terms[at(k)], lengths);
  }
}

}  // namespace

template <int D>
CellTargets<D> with_corner_lengths(CellTargets<D> targets, const Coordinates& x) {
  if (x.dimension() == 2)
    take_lengths(targets, PlanePoints(x));
  else
    take_lengths(targets, SpacePoints(x));
  return targets;
}

template CellTargets<2> with_corner_lengths(CellTargets<2>, const Coordinates&);
template CellTargets<3> with_corner_lengths(CellTargets<3>, const Coordinates&);

}  // namespace winslow
