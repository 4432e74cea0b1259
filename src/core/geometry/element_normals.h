#pragma once

#include "core/geometry/sliding_boundary.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// Which way the elements of a surface mesh should face, by the surface and not by the elements
/// themselves: what tells an element that is turned over from one that is not.
///
/// The reference normal of an element is the mean of the surface's normals at its nodes, on the
/// side to which the elements of that part of the surface face; nodes on feature lines, where the
/// surface has no one normal, do not count. An element with no other nodes has the normal that it
/// had in the mesh as given.
class ElementNormals {
 public:
  /// given: the mesh that the boundary was found in.
  ElementNormals(std::shared_ptr<const Topology> topology, const Coordinates& given,
                 const SlidingBoundary& boundary);
  /// The same, asking another object for the places of nodes on the same surface.
  ElementNormals asking(std::shared_ptr<const SlidingGeometry> geometry) const;

  /// #elements, unit vectors. threads: 0 for all cores.
  std::vector<Vec3> of_elements(const Coordinates& x, int threads) const;
  /// Of one element.
  Vec3 of_element(Index element, const Coordinates& x) const;

 private:
  struct Sides;
  Vec3 node_normal(Index node, const Vec3& point) const;
  Vec3 from_nodes(Index element, const Vec3& sum) const;

  std::shared_ptr<const Topology> topology_;
  std::shared_ptr<const SlidingGeometry> geometry_;
  std::shared_ptr<const Sides> sides_;
};

/// Twice the area of an element of a surface mesh, as a vector at right angles to it.
Vec3 area_vector(const Points<3>& x, std::span<const Index> element);

}  // namespace winslow
