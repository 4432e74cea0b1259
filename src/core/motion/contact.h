#pragma once

#include "core/mesh/mesh.h"
#include "core/motion/motion.h"

/// Reports what blocked a motion:
///
///     const winslow::SmoothResult smooth = winslow::execute(command, state).smooth;
///     if (smooth.contact) std::puts(winslow::describe(*smooth.contact).c_str());
namespace winslow {

/// Two boundary edges of a plane mesh, or two boundary faces of a volume mesh, identified by their
/// markers.
struct EdgePair {
  /// Marker names; empty: no marker; "what is prescribed inside": around what a motion moves as a
  /// whole inside the mesh.
  std::string moving, other;
  Vec3 place{0, 0, 0};  ///< position at which they meet or are nearest, in units of the mesh
  /// The two sides of a sheet without thickness, which lie on one another before the motion.
  bool one_sheet = false;
  bool in_space = false;  ///< whether the place has a third component

  bool operator==(const EdgePair&) const = default;
};

/// Converts the place from the coordinates of the frame to those of the mesh.
void put_in_mesh(EdgePair& edges, const LocalFrame& frame);

/// The contact of a moving part of the boundary with another part. Beyond it, no mesh without
/// inverted elements exists.
struct Contact {
  double fraction = 0;  ///< share of the motion up to which the edges are still apart
  EdgePair edges;

  bool operator==(const Contact&) const = default;
};

/// Finds the first contact along a motion. Tests edges with a moving node against all other
/// boundary edges and edges of markers; in space faces, with quadrilaterals as two triangles. An
/// interval of the motion is free if the swept boxes do not overlap. Other intervals are halved
/// down to 1/1024 of the motion, and the edges are then tested for intersection, so a shorter
/// contact may be missed. None if edges or faces cross before the motion begins; pairs that touch
/// then are ignored. The two sides of a crack or of a baffle without thickness, whose nodes lie in
/// the same places, may part but not pass through each other (sheets.h). rest: all nodes before
/// the motion. If several bodies move,
/// each is also tested against the other moving bodies. yielding: boundary nodes that give way;
/// their edges and faces are ignored.
std::optional<Contact> find_contact(const Topology& topology, const Coordinates& rest,
                                    const Motion& motion, std::span<const Index> yielding = {});

/// The distance between the moving boundary and the rest of the boundary.
struct Gap {
  double width = 0;  ///< in units of the mesh
  EdgePair edges;

  bool operator==(const Gap&) const = default;
};

/// The smallest distance between edges (in space: faces) with moving nodes and those with fixed
/// nodes; none if there are no such pairs without a common node. moving: ascending.
std::optional<Gap> smallest_gap(const Topology& topology, const Coordinates& x,
                                std::span<const Index> moving,
                                std::span<const Index> yielding = {});
/// The same for the nodes of a motion; for several bodies, also between the bodies.
std::optional<Gap> smallest_gap(const Topology& topology, const Coordinates& x,
                                const Motion& motion, std::span<const Index> yielding = {});

/// "flap would touch main".
std::string describe_touch(const EdgePair& edges);
/// "flap would touch main at 32.4 % of the way".
std::string describe(const Contact& contact);
/// "flap is 0.0012 from main there".
std::string describe(const Gap& gap);

}  // namespace winslow
