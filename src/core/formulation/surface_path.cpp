#include "core/formulation/surface_path.h"

#include <utility>

namespace winslow {

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
