#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/vcv/sphere/sphere_fit.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/sphere/sphere_perturbation.h"
#include "core/vcv/sphere/sphere_start.h"

namespace winslow {

/// How the directions of a VCV are found for given solid angles.
enum class VcvConstruction : std::uint8_t {
  fit,          ///< see SphereFit
  perturbation  ///< the paper's, see perturb_directions()
};

/// Solid angles of one star as they are to be in a VCV, and what they are made of.
class StarTargets {
 public:
  /// 4 pi / #triangles each.
  std::span<const double> equal(const SphereLink& link);
  /// The physical ones: solid angles of the directions to the neighbours, none below a hundredth of
  /// the equal one, scaled to a sum of 4 pi.
  std::span<const double> existing(const SphereLink& link, std::span<const Vec3> physical);
  /// AIAA 2009-1362, section V: the mean of the equal and the physical ones, these taken as zero
  /// where they are negative, scaled to a sum of 4 pi.
  std::span<const double> adjusted(const SphereLink& link, std::span<const Vec3> physical);

 private:
  void measure(const SphereLink& link, std::span<const Vec3> physical, double floor);
  std::span<const double> scaled();

  std::vector<double> angles_;
};

/// Unit vectors from a node to its neighbours (#neighbours).
void physical_directions(const SpacePoints& x, Index node, std::span<const Index> neighbours,
                         std::vector<Vec3>& out);

/// Makes VCVs, one star after another, in memory that it keeps.
class StarBuilder {
 public:
  explicit StarBuilder(VcvConstruction construction) : construction_(construction) {}

  /// Directions for the targets (#triangles). directions: #vertices; where to start from if they
  /// cover the sphere, otherwise that is worked out from the link; then the result. seed: of the
  /// perturbation. Throws NumericError as SphereStart does.
  SphereFitResult build(const SphereLink& link, std::span<const double> targets,
                        const SphereFitOptions& options, std::uint64_t seed,
                        std::span<Vec3> directions);

 private:
  VcvConstruction construction_;
  SphereStart start_;
  SphereFit fit_;
};

/// Largest magnitude of Omega / Omega* - 1 of a star.
double largest_angle_error(const SphereLink& link, std::span<const double> targets,
                           std::span<const Vec3> directions);

}  // namespace winslow
