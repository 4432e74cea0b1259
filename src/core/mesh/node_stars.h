#pragma once

#include "core/mesh/curve_order.h"
#include "core/mesh/element_type.h"
#include "core/mesh/face_pairs.h"
#include "core/mesh/index_sets.h"

namespace winslow {

class HalfEdgeMesh;
class Topology;

/// What lies around each node (#nodes rows): its edge neighbours and the elements that it is a
/// corner of. Rows of unused nodes are empty.
struct NodeStars {
  CompressedRows neighbours, elements;
};

/// Of a plane or surface mesh, by a turn around each node; ordered as Topology::neighbours() says.
/// elements: those of the half-edge mesh. Throws MeshError naming a node with two separate stars.
NodeStars surface_stars(const HalfEdgeMesh& mesh, const CompressedRows& elements);

/// The elements around each node of a volume mesh, ascending. elements: their corners.
CompressedRows star_rows(const CompressedRows& elements, Index node_count);

/// The same in an order in which the surroundings of one node after the other are quickly looked
/// through; nodes and elements by their numbers in it.
struct OrderedStars {
  /// corners: of the elements, as they are oriented.
  OrderedStars(const MeshData& data, const CompressedRows& corners);

  CurveOrder order;
  CompressedRows elements;  ///< around nodes
  std::vector<ElementType> types;
};

/// Edge neighbours of each node of the mesh, ascending.
CompressedRows volume_neighbours(const OrderedStars& stars);

/// Boundary loops of a plane or surface mesh, elements on the left: each starts at its lowest node,
/// and they are in the order of these.
std::vector<std::vector<Index>> boundary_loops(const HalfEdgeMesh& mesh);

/// Throws MeshError naming a node of a plane or surface mesh at which more than two boundary edges
/// meet.
void check_surface_manifold(const MeshData& data, const FacePairs& pairs);

/// Throws MeshError naming a node of a volume mesh around which the elements do not fill one ball
/// or, on the boundary, half of one: parts of the mesh, or of its boundary, that meet in this node
/// or in an edge only. topology: with its faces and neighbours.
void check_volume_manifold(const Topology& topology, const OrderedStars& stars);

}  // namespace winslow
