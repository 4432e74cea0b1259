#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/motion/motion.h"

namespace winslow {

/// Two edges of the boundary, by the markers that they belong to.
struct EdgePair {
  std::string moving, other;  ///< names; empty: an edge of no marker
  Vec2 place{0, 0};           ///< where they meet or are nearest, in units of the mesh

  bool operator==(const EdgePair&) const = default;
};

/// Where the boundary of a plane mesh runs into itself when a part of it moves. No mesh without
/// inverted elements exists from there on.
struct Contact {
  double fraction = 0;  ///< of the motion, at which they are apart for the last time
  EdgePair edges;

  bool operator==(const Contact&) const = default;
};

/// The first contact along a motion: edges of which a node moves against all other boundary edges
/// and edges of markers. Intervals of the motion in which the boxes swept by the edges stay apart
/// are free; others are halved down to 1/1024 of the motion and there judged by whether edges
/// meet, so a touch shorter than that may go unnoticed. None if edges cross before the motion
/// begins; edges that touch then, as those of a crack do, are left out. rest: all nodes before the
/// motion. Boundaries of volume meshes are not searched yet: none.
std::optional<Contact> find_contact(const Topology& topology, const Coordinates& rest,
                                    const Motion& motion);

/// How near the moving boundary is to the rest of it.
struct Gap {
  double width = 0;  ///< in units of the mesh
  EdgePair edges;

  bool operator==(const Gap&) const = default;
};

/// The smallest distance of edges whose nodes move to edges whose nodes stay; none if there are no
/// such edges, or only edges that share a node; none in a volume mesh yet. moving: ascending.
std::optional<Gap> smallest_gap(const Topology& topology, const Coordinates& x,
                                std::span<const Index> moving);

/// "flap would touch main".
std::string describe_touch(const EdgePair& edges);
/// "flap would touch main at 32.4 % of the way".
std::string describe(const Contact& contact);
/// "flap is 0.0012 from main there".
std::string describe(const Gap& gap);

}  // namespace winslow
