#include "core/formulation/target_path.h"

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

TargetMetric own_metric(const PlanePoints& x, const std::array<Index, 3>& cell, const ShapeTerm&) {
  return TargetMetric::of(x[cell[1]] - x[cell[0]], x[cell[2]] - x[cell[0]]);
}

/// Of a cell that is as good as flat that at the end of the way.
Eigen::Matrix3d own_metric(const SpacePoints& x, const std::array<Index, 4>& cell,
                           const VolumeTerm& end) {
  Edges3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x[cell[at(k + 1)]] - x[cell[0]];
  return has_metric(edges) ? volume_metric(edges) : metric_of(end);
}

ShapeTerm on_the_way(const TargetMetric& own, const ShapeTerm& term, double share) {
  return between(own, TargetMetric::of(term), share).term(term.weight);
}

VolumeTerm on_the_way(const Eigen::Matrix3d& own, const VolumeTerm& term, double share) {
  return volume_term(RelativeMetric(own, metric_of(term)).between(share), term.weight);
}

}  // namespace

template <int D>
ShapePath<D>::ShapePath(std::shared_ptr<const SimplexWinslow<D>> end, const Coordinates& from,
                        int threads)
    : end_(std::move(end)), threads_(threads) {
  const Points<D> x(from);
  own_.reserve(end_->shapes().cells.size());
  const CellTargets<D>& shapes = end_->shapes();
  for (std::size_t t = 0; t < shapes.cells.size(); ++t)
    own_.push_back(own_metric(x, shapes.cells[t], shapes.terms[at(shapes.offsets[t])]));
}

template <int D>
std::shared_ptr<const SimplexWinslow<D>> ShapePath<D>::form_at(double share) const {
  if (share >= 1) return end_;
  CellTargets<D> shapes = end_->shapes();
  const auto count = static_cast<Index>(own_.size());
  parallel_for(threads_, count, [&](Index begin, Index stop) {
    for (Index t = begin; t < stop; ++t) {
      for (Index k = shapes.offsets[at(t)]; k < shapes.offsets[at(t) + 1]; ++k)
        shapes.terms[at(k)] = on_the_way(own_[at(t)], shapes.terms[at(k)], share);
    }
  });
  return end_->with_ordered_shapes(std::make_shared<const CellTargets<D>>(std::move(shapes)));
}

template class ShapePath<2>;
template class ShapePath<3>;

SurfacePath::SurfacePath(std::shared_ptr<const SurfaceWinslow> end, const Coordinates& from)
    : end_(std::move(end)) {
  const SpacePoints x(from);
  own_.reserve(end_->shapes().cells.size());
  for (const auto& cell : end_->shapes().cells) {
    const Vec3 u = x[cell[1]] - x[cell[0]], v = x[cell[2]] - x[cell[0]];
    own_.push_back(TargetMetric::in_space(u, v));
  }
}

std::shared_ptr<const VariationalForm> SurfacePath::at_share(double share) const {
  if (share >= 1) return end_;
  CellTargets<2> shapes = end_->shapes();
  for (std::size_t t = 0; t < own_.size(); ++t) {
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      ShapeTerm& term = shapes.terms[at(k)];
      term = between(own_[t], TargetMetric::of(term), share).term(term.weight);
    }
  }
  return end_->with_shapes(std::make_shared<const CellTargets<2>>(std::move(shapes)));
}

}  // namespace winslow
