#include "core/formulation/target_path.h"

#include <utility>

#include "core/parallel/parallel_for.h"

namespace winslow {

TargetPath::TargetPath(std::shared_ptr<const VariationalWinslow> end, const Coordinates& from,
                       int threads)
    : end_(std::move(end)), threads_(threads) {
  const PlanePoints x(from);
  own_.reserve(end_->shapes().triangles.size());
  for (const auto& [a, b, c] : end_->shapes().triangles)
    own_.push_back(TargetMetric::of(x[b] - x[a], x[c] - x[a]));
}

std::shared_ptr<const VariationalWinslow> TargetPath::at_share(double share) const {
  if (share >= 1) return end_;
  TargetShapes shapes = end_->shapes();
  const auto count = static_cast<Index>(own_.size());
  parallel_for(threads_, count, [&](Index begin, Index stop) {
    for (Index t = begin; t < stop; ++t) {
      for (Index k = shapes.offsets[at(t)]; k < shapes.offsets[at(t) + 1]; ++k) {
        ShapeTerm& term = shapes.terms[at(k)];
        term = between(own_[at(t)], TargetMetric::of(term), share).term(term.weight);
      }
    }
  });
  return end_->with_ordered_shapes(std::make_shared<const TargetShapes>(std::move(shapes)));
}

}  // namespace winslow
