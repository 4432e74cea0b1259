#pragma once

#include <cstdint>
#include <span>

#include "core/vcv/sphere/sphere_link.h"

namespace winslow {

struct PerturbationOptions {
  double first_reach = 0.2;   ///< of a perturbation, in radians
  double least_reach = 1e-3;  ///< where the search ends
  int directions = 8;         ///< perturbations of a vertex, one after the other, in each sweep
  int most_sweeps = 200;
};

/// The paper's way to place the vertices of a link (AIAA 2009-1362, section IV): each is perturbed
/// in random directions on the sphere, and what lowers its cost (see vertex_cost()) is kept. The
/// reach is halved after a sweep that lowers no cost by a hundredth. Returns the number of sweeps.
///
/// targets: #triangles, in steradians. directions: #vertices, unit vectors; the start, and then the
/// result. The same seed gives the same bits.
int perturb_directions(const SphereLink& link, std::span<const double> targets,
                       const PerturbationOptions& options, std::uint64_t seed,
                       std::span<Vec3> directions);

}  // namespace winslow
