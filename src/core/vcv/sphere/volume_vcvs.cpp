#include "core/vcv/sphere/volume_vcvs.h"

#include "core/error.h"
#include "core/parallel/parallel_for.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

namespace {

/// Stars per block of a thread: one star takes as long as hundreds of rows in other loops.
constexpr Index star_block = 64;

void require_volume(const Topology& topology) {
  require_volume(topology,
                 "virtual control volumes of solid angles: expected a volume mesh, found a ");
}

}  // namespace

/// Computes the directions of single stars.
class VolumeVcvs::StarSolver {
 public:
  /// physical: null for equal angles. first: no directions exist yet.
  StarSolver(VolumeVcvs& vcvs, const Coordinates* physical, bool first)
      : vcvs_(vcvs),
        physical_(physical),
        first_(first),
        fit_(vcvs.options_.fit()),
        builder_(vcvs.options_.construction) {}

  /// Returns true if the star was solved, false if its targets are unchanged.
  bool solve(std::size_t i) {
    const Topology& topology = *vcvs_.topology_;
    const Index node = topology.interior_nodes()[i];
    const auto neighbours = topology.neighbours(node);
    link_.assign(topology, node);
    directions_.assign(neighbours.size(), Vec3(0, 0, 0));
    if (physical_) physical_directions(SpacePoints(*physical_), node, neighbours, directions_);
    const auto wanted = targets_.of_kind(vcvs_.options_.angles, link_, directions_);
    if (!keep_targets(i, wanted)) return false;
    if (!first_) {
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        directions_[k] = vcvs_.computed(node, static_cast<Index>(k));
      }
    }
    try {
      const auto seed = static_cast<std::uint64_t>(node);
      vcvs_.ends_[i] = builder_.build(link_, wanted, fit_, seed, directions_).end;
    } catch (const NumericError& error) {
      throw MeshError(MeshEntity::node, node, "node " + std::to_string(node) + ": " + error.what());
    }
    float* out = vcvs_.directions_.data() + 3 * at(topology.neighbour_rows().offsets[at(node)]);
    for (const Vec3& direction : directions_) {
      for (int c = 0; c < 3; ++c) *out++ = static_cast<float>(direction[c]);
    }
    return true;
  }

 private:
  /// Stores the targets of a star. Returns false if they are unchanged.
  bool keep_targets(std::size_t i, std::span<const double> wanted) {
    if (vcvs_.rows_.empty()) return true;
    float* const row = vcvs_.targets_.data() + vcvs_.rows_[i];
    bool changed = first_;
    for (std::size_t t = 0; t < wanted.size(); ++t) {
      changed = changed || std::abs(wanted[t] - row[t]) > fit_.tolerance * wanted[t];
    }
    if (changed) {
      std::transform(wanted.begin(), wanted.end(), row,
                     [](double angle) { return static_cast<float>(angle); });
    }
    return changed;
  }

  VolumeVcvs& vcvs_;
  const Coordinates* physical_;
  bool first_;
  SphereFitOptions fit_;
  SphereLink link_;
  StarTargets targets_;
  StarBuilder builder_;
  std::vector<Vec3> directions_;
};

VolumeVcvs::VolumeVcvs(std::shared_ptr<const Topology> topology, const VolumeVcvOptions& options)
    : topology_(std::move(topology)), options_(options) {
  require_volume(*topology_);
  if (options_.angles != VcvAngles::equal || options_.length_power != 0) {
    throw UsageError(
        "existing and adjusted solid angles, and edge lengths, need the coordinates of a mesh");
  }
  solve(nullptr, true);
}

VolumeVcvs::VolumeVcvs(std::shared_ptr<const Topology> topology, const Coordinates& physical,
                       const VolumeVcvOptions& options)
    : topology_(std::move(topology)), options_(options) {
  require_volume(*topology_);
  solve(options_.angles == VcvAngles::equal ? nullptr : &physical, true);
  if (options_.length_power != 0) take_lengths(physical);
}

void VolumeVcvs::take_lengths(const Coordinates& physical) {
  lengths_.assign(topology_->neighbour_rows().values.size(), 1.0F);
  const SpacePoints x(physical);
  const auto interior = topology_->interior_nodes();
  parallel_for(options_.threads, static_cast<Index>(interior.size()), [&](Index begin, Index end) {
    std::vector<double> lengths;
    for (Index i = begin; i < end; ++i) {
      const Index node = interior[at(i)];
      graded_lengths(x, node, topology_->neighbours(node), options_.length_power, lengths);
      std::transform(lengths.begin(), lengths.end(),
                     lengths_.begin() + topology_->neighbour_rows().offsets[at(node)],
                     [](double length) { return static_cast<float>(length); });
    }
  });
}

Index VolumeVcvs::adjust(const Coordinates& physical) {
  if (options_.angles != VcvAngles::adjusted) {
    throw UsageError("only adjusted solid angles follow the mesh");
  }
  return solve(&physical, false);
}

Index VolumeVcvs::solve(const Coordinates* physical, bool first) {
  const auto interior = topology_->interior_nodes();
  const auto count = static_cast<Index>(interior.size());
  if (first) {
    directions_.assign(3 * topology_->neighbour_rows().values.size(), 0.0F);
    ends_.assign(interior.size(), SphereFitEnd::out_of_steps);
    if (physical) {
      rows_.assign(1, 0);
      for (const Index node : interior) {
        // Number of triangles of a sphere with n vertices (Euler); the solver refuses other links.
        const std::size_t n = topology_->neighbours(node).size();
        rows_.push_back(rows_.back() + (n > 2 ? 2 * n - 4 : 0));
      }
      targets_.assign(rows_.back(), 0.0F);
    }
  }
  std::vector<Index> solved(block_count(count, star_block), 0);
  parallel_for(
      options_.threads, count,
      [&](Index begin, Index end) {
        StarSolver solver(*this, physical, first);
        for (Index i = begin; i < end; ++i) {
          if (solver.solve(at(i))) ++solved[at(begin / star_block)];
        }
      },
      star_block);
  return std::accumulate(solved.begin(), solved.end(), Index{0});
}

Vec3 VolumeVcvs::computed(Index node, Index k) const {
  const float* const d =
      directions_.data() + 3 * at(topology_->neighbour_rows().offsets[at(node)] + k);
  return Vec3(d[0], d[1], d[2]).normalized();
}

Vec3 VolumeVcvs::direction(Index node, Index k) const {
  const auto found = edited_.find(node);
  return found != edited_.end() ? found->second.directions[at(k)] : computed(node, k);
}

double VolumeVcvs::length(Index node, Index k) const {
  const auto found = edited_.find(node);
  if (found != edited_.end()) return found->second.lengths[at(k)];
  return lengths_.empty() ? 1.0 : lengths_[at(topology_->neighbour_rows().offsets[at(node)] + k)];
}

void VolumeVcvs::points(Index node, std::vector<Vec3>& out) const {
  out.clear();
  const auto count = static_cast<Index>(topology_->neighbours(node).size());
  for (Index k = 0; k < count; ++k) out.push_back(point(node, k));
}

void VolumeVcvs::set(Index node, std::span<const Vec3> directions,
                     std::span<const double> lengths) {
  edited_[node] = checked_stencil(*topology_, node, directions, lengths);
}

void VolumeVcvs::reset(Index node) {
  require_vcv_node(*topology_, node);
  edited_.erase(node);
}

void VolumeVcvs::targets(std::size_t i, const SphereLink& link, std::vector<double>& out) const {
  if (rows_.empty()) {
    out.assign(at(link.triangle_count()), 4 * pi / link.triangle_count());
    return;
  }
  const float* const row = targets_.data() + rows_[i];
  out.assign(row, row + link.triangle_count());
}

namespace {

constexpr double near_enough = 1e-3;

/// Accumulates the statistics of stars; mean_error holds the sum until the end.
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
  std::vector<VolumeVcvStatistics> parts(block_count(count, block));
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
