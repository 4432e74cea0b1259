#pragma once

#include "core/geometry/sliding_boundary.h"

/// Finds what the nodes of moving bodies stand on: a half wing on its symmetry plane, a piston
/// between the walls of its cylinder.
///
/// find_footholds() takes the markers that may give way and the nodes of the bodies
/// (FootholdQuery); a run does so in let_footholds_slide().
namespace winslow {

/// A part of a marker without features, or an edge between such parts, on which nodes of moving
/// bodies lie.
struct Foothold {
  std::string body;                  ///< a marker of these nodes that moves
  std::vector<std::string> markers;  ///< one; those on both sides of an edge
  bool edge = false;
  std::string description;   ///< "plane", "straight line", "smooth surface through 80 nodes"
  std::vector<Index> nodes;  ///< of the bodies, ascending
  /// True for a straight line, a circle, a plane, a cylinder and a sphere: they are known beyond
  /// the nodes of the mesh.
  bool goes_on = false;
  std::function<Vec3(const Vec3&)> nearest;  ///< its point nearest to a point

  /// "symmetry", or "the edge between left and right".
  std::string name() const;
};

/// What is looked for, in the markers of which boundary.
struct FootholdQuery {
  std::vector<std::string> markers = {};  ///< that give way where bodies stand on them
  /// Markers that slide in any case, on the shapes of the mesh. Only edges between their parts
  /// are looked for.
  std::vector<std::string> sliding = {};
  std::span<const Index> moving;    ///< nodes of the bodies, ascending
  std::span<const Index> standing;  ///< those of them that move the boundary with them, ascending
  std::vector<unsigned char> taken{};  ///< 1 for nodes that do not slide on footholds (#nodes)
  double angle = 40;                   ///< degrees by which a boundary turns at a corner or an edge
};

struct Footholds {
  std::vector<Foothold> all;
  /// The parts whose nodes may slide on footholds that go on, with their geometry.
  SlidingBoundary sliding;
};

/// The markers of the boundary that have nodes in `standing` and others that are not in `moving`,
/// in their order in the mesh.
std::vector<std::string> markers_underfoot(const Topology& topology, std::span<const Index> moving,
                                           std::span<const Index> standing);

/// A marker all of whose nodes are in `moving` (ascending) and that has the node; empty if there is
/// none.
std::string body_with(const Topology& topology, std::span<const Index> moving, Index node);

/// Finds the parts of the markers, cut at their features as SlidingBoundary does, on which standing
/// nodes lie. In space edges in which such parts meet are footholds as well if standing nodes lie
/// on them and other nodes can slide along them. For plane and volume meshes.
Footholds find_footholds(const Topology& topology, const Coordinates& x,
                         const FootholdQuery& query);

}  // namespace winslow
