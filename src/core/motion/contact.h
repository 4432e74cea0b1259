#pragma once

#include "core/mesh/mesh.h"
#include "core/motion/motion.h"

/// What stood in the way of a motion:
///
///     const winslow::SmoothResult smooth = winslow::execute(command, state).smooth;
///     if (smooth.contact) std::puts(winslow::describe(*smooth.contact).c_str());
namespace winslow {

/// Two edges of the boundary of a plane mesh, or two faces of that of a volume mesh, by the markers
/// that they belong to.
struct EdgePair {
  std::string moving, other;  ///< names; empty: of no marker
  Vec3 place{0, 0, 0};        ///< where they meet or are nearest, in units of the mesh

  bool operator==(const EdgePair&) const = default;
};

/// Takes the place from a frame to the mesh.
void put_in_mesh(EdgePair& edges, const LocalFrame& frame);

/// Where the boundary of a mesh runs into itself when a part of it moves. No mesh without inverted
/// elements exists from there on.
struct Contact {
  double fraction = 0;  ///< of the motion, at which they are apart for the last time
  EdgePair edges;

  bool operator==(const Contact&) const = default;
};

/// The first contact along a motion: edges of which a node moves against all other boundary edges
/// and edges of markers; in space faces, of which those with four nodes count as two triangles.
/// Intervals of the motion in which the boxes that they sweep stay apart are free; others are
/// halved down to 1/1024 of the motion and there judged by whether they meet, so a touch shorter
/// than that may go unnoticed. None if edges or faces cross before the motion begins; those that
/// touch then, as those of a crack do, are left out. rest: all nodes before the motion.
/// Bodies of a motion of several are looked at together, each against the others as they move.
/// yielding: nodes of the boundary that give way, whose edges and faces are in nothing's way.
std::optional<Contact> find_contact(const Topology& topology, const Coordinates& rest,
                                    const Motion& motion, std::span<const Index> yielding = {});

/// How near the moving boundary is to the rest of it.
struct Gap {
  double width = 0;  ///< in units of the mesh
  EdgePair edges;

  bool operator==(const Gap&) const = default;
};

/// The smallest distance of edges (in space: faces) whose nodes move to those whose nodes stay;
/// none if there are no such, or only such that share a node. moving: ascending.
std::optional<Gap> smallest_gap(const Topology& topology, const Coordinates& x,
                                std::span<const Index> moving,
                                std::span<const Index> yielding = {});
/// That of what a motion moves; of several bodies, also between one and another.
std::optional<Gap> smallest_gap(const Topology& topology, const Coordinates& x,
                                const Motion& motion, std::span<const Index> yielding = {});

/// "flap would touch main".
std::string describe_touch(const EdgePair& edges);
/// "flap would touch main at 32.4 % of the way".
std::string describe(const Contact& contact);
/// "flap is 0.0012 from main there".
std::string describe(const Gap& gap);

}  // namespace winslow
