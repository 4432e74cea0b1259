#include "core/vcv/sphere/volume_vcv_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel/parallel_for.h"
#include "core/vcv/sphere/solid_angle.h"
#include "core/vcv/sphere/star_cost.h"

namespace winslow {

namespace {

constexpr double near_enough = 1e-3;

/// Statistics of one star after another; mean_error holds the sum until the end.
class StarMeasure {
 public:
  StarMeasure() {
    sum.min_angle = sum.min_cost = std::numeric_limits<double>::infinity();
    sum.max_angle = -std::numeric_limits<double>::infinity();
  }

  void add(const VolumeVcvs& vcvs, std::size_t i) {
    const Index node = vcvs.topology().interior_nodes()[i];
    if (vcvs.edited(node)) return;
    link_.assign(vcvs.topology(), node);
    vcvs.targets(i, link_, targets_);
    vcvs.points(node, points_);
    double worst = 0;
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      const auto [a, b, c] = link_.triangles()[t];
      const double angle = solid_angle(points_[at(a)], points_[at(b)], points_[at(c)]);
      const double error = std::abs(angle / targets_[t] - 1);
      sum.min_angle = std::min(sum.min_angle, angle);
      sum.max_angle = std::max(sum.max_angle, angle);
      sum.mean_error += error;
      worst = std::max(worst, error);
    }
    const StarCost cost = star_cost(link_, targets_, points_);
    sum.min_cost = std::min(sum.min_cost, cost.min);
    sum.max_cost = std::max(sum.max_cost, cost.max);
    sum.max_error = std::max(sum.max_error, worst);
    ++sum.stars;
    sum.triangles += link_.triangle_count();
    if (worst > near_enough) ++sum.off;
    if (vcvs.fit_end(i) == SphereFitEnd::limited_by_shape) ++sum.limited_by_shape;
    if (vcvs.fit_end(i) == SphereFitEnd::out_of_steps) ++sum.out_of_steps;
  }

  VolumeVcvStatistics sum;

 private:
  SphereLink link_;
  std::vector<double> targets_;
  std::vector<Vec3> points_;
};

void add(VolumeVcvStatistics& total, const VolumeVcvStatistics& part) {
  total.stars += part.stars;
  total.triangles += part.triangles;
  total.min_angle = std::min(total.min_angle, part.min_angle);
  total.max_angle = std::max(total.max_angle, part.max_angle);
  total.min_cost = std::min(total.min_cost, part.min_cost);
  total.max_cost = std::max(total.max_cost, part.max_cost);
  total.mean_error += part.mean_error;
  total.max_error = std::max(total.max_error, part.max_error);
  total.off += part.off;
  total.limited_by_shape += part.limited_by_shape;
  total.out_of_steps += part.out_of_steps;
}

}  // namespace

VolumeVcvStatistics measure_vcvs(const VolumeVcvs& vcvs, int threads) {
  constexpr Index block = 256;
  const auto count = static_cast<Index>(vcvs.topology().interior_nodes().size());
  std::vector<VolumeVcvStatistics> parts(at((count + block - 1) / block));
  parallel_for(
      threads, count,
      [&](Index begin, Index end) {
        StarMeasure measure;
        for (Index i = begin; i < end; ++i) measure.add(vcvs, at(i));
        parts[at(begin / block)] = measure.sum;
      },
      block);
  VolumeVcvStatistics total = StarMeasure().sum;
  for (const VolumeVcvStatistics& part : parts) add(total, part);
  if (total.stars == 0) return {};
  total.mean_error /= total.triangles;
  return total;
}

}  // namespace winslow
