#include "core/formulation/target_path.h"

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

template <int S>
TargetMetric own_metric(const Points<S>& x, const std::array<Index, 3>& cell, const ShapeTerm&) {
  return TargetMetric::of(Vec<S>(x[cell[1]] - x[cell[0]]), Vec<S>(x[cell[2]] - x[cell[0]]));
}

/// The cell's own metric; for an almost flat cell that at the end of the path.
Eigen::Matrix3d own_metric(const SpacePoints& x, const std::array<Index, 4>& cell,
                           const VolumeTerm& end) {
  Edges3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x[cell[at(k + 1)]] - x[cell[0]];
  return has_metric(edges) ? volume_metric(edges) : metric_of(end);
}

/// f of a cell with this metric, for a term.
double distortion_between(const TargetMetric& own, const ShapeTerm& term) {
  return std::cosh(stretch_between(own, TargetMetric::of(term)));
}
double distortion_between(const Eigen::Matrix3d& own, const VolumeTerm& term) {
  return (metric_of(term) * own.inverse()).trace() / 3;
}

ShapeTerm on_the_way(const TargetMetric& own, const ShapeTerm& term, double share) {
  return between(own, TargetMetric::of(term), share).term(term.weight);
}

VolumeTerm on_the_way(const Eigen::Matrix3d& own, const VolumeTerm& term, double share) {
  return volume_term(RelativeMetric(own, metric_of(term)).between(share), term.weight);
}

}  // namespace

template <int D>
template <int S>
ShapePath<D>::ShapePath(std::shared_ptr<const TargetForm<D>> end, const Points<S>& from,
                        int threads)
    : end_(std::move(end)), threads_(threads) {
  const CellTargets<D>& shapes = end_->shapes();
  own_.reserve(shapes.cells.size());
  for (std::size_t t = 0; t < shapes.cells.size(); ++t)
    own_.push_back(own_metric(from, shapes.cells[t], shapes.terms_of(t).front()));
  if (!end_->has_guards()) return;
  for (std::size_t t = 0; t < shapes.cells.size(); ++t)
    for (const auto& term : shapes.terms_of(t)) seen_.push_back(distortion_between(own_[t], term));
}

template <int D>
std::shared_ptr<const TargetForm<D>> ShapePath<D>::form_at(double share) const {
  if (share >= 1) return end_;
  CellTargets<D> shapes = end_->shapes();
  const auto count = static_cast<Index>(own_.size());
  parallel_for(threads_, count, [&](Index begin, Index stop) {
    for (std::size_t t = at(begin); t < at(stop); ++t)
      for (auto k = at(shapes.offsets[t]); k < at(shapes.offsets[t + 1]); ++k) {
        const double inverse_limit = shapes.inverse_limit(k);
        // A guard has no effect at the valid mesh, and its own limit at the end.
        if (inverse_limit > 0)
          shapes.inverse_limits[k] = std::min(inverse_limit, 1 / ((1 - share) * seen_[k]));
        else
          shapes.terms[k] = on_the_way(own_[t], shapes.terms[k], share);
      }
  });
  return end_->with_shapes(std::make_shared<const CellTargets<D>>(std::move(shapes)));
}

template class ShapePath<2>;
template class ShapePath<3>;
template ShapePath<2>::ShapePath(std::shared_ptr<const TargetForm<2>>, const PlanePoints&, int);
template ShapePath<2>::ShapePath(std::shared_ptr<const TargetForm<2>>, const SpacePoints&, int);
template ShapePath<3>::ShapePath(std::shared_ptr<const TargetForm<3>>, const SpacePoints&, int);

}  // namespace winslow
