#pragma once

#include "core/geometry/periodic_pairs.h"
#include "core/motion/motion.h"

namespace winslow {

/// A motion that also takes the images of its nodes across periodic sides, and their images: each
/// goes the way of its node, turned as the image is. So the sides still match where a body ends on
/// one of them, or is one. Returns null if no node has an image that does not move by itself.
/// `motion` must outlive the result.
///
/// Throws UsageError, naming the nodes, if the motion takes a node and its image to places that are
/// no images of one another.
std::unique_ptr<const Motion> with_images(const Motion& motion, const Coordinates& rest,
                                          std::span<const PeriodicPairs> sides);

}  // namespace winslow
