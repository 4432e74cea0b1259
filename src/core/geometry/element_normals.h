#pragma once

#include "core/geometry/sliding_boundary.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// Reference normals of the elements of a surface mesh. An element is turned over if it faces away
/// from its reference normal.
///
/// The reference normal of an element is the mean of the normals of the surface at its nodes. It
/// points to the side to which most area of that part of the surface faces. Nodes on feature lines,
/// where the surface has several normals, do not count. An element with all nodes on feature lines
/// has the normal that it has in the given mesh.
class ElementNormals {
 public:
  /// given: coordinates of the mesh in which the boundary was found.
  ElementNormals(std::shared_ptr<const Topology> topology, const Coordinates& given,
                 const SlidingBoundary& boundary);
  /// The same with another geometry for the same surface, such as RememberedFeet.
  ElementNormals with_geometry(std::shared_ptr<const SlidingGeometry> geometry) const;

  /// Unit reference normals (#elements). threads: 0 for all cores.
  std::vector<Vec3> of_elements(const Coordinates& x, int threads) const;
  /// The reference normal of one element.
  Vec3 of_element(Index element, const Coordinates& x) const;

 private:
  struct Sides;
  Vec3 node_normal(Index node, const Vec3& point) const;
  Vec3 from_nodes(Index element, const Vec3& sum) const;

  std::shared_ptr<const Topology> topology_;
  std::shared_ptr<const SlidingGeometry> geometry_;
  std::shared_ptr<const Sides> sides_;
};

/// Twice the area vector of an element of a surface mesh.
Vec3 doubled_area_vector(const Points<3>& x, std::span<const Index> element);

}  // namespace winslow
