#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/mesh/face_pairs.h"
#include "core/mesh/index_sets.h"
#include "core/search/box_tree.h"

namespace winslow {

/// The nodes and elements of a volume mesh in the order of the Z-order curve through a box:
/// neighbours in space are neighbours in memory. In mesh files they may have any order, and loops
/// over the stars of many nodes would spend most of their time on cache misses. The order stays
/// useful when nodes move.
struct CurveOrder {
  /// corners: of the elements. A node outside the box counts as on the nearest face of the box.
  CurveOrder(const SpacePoints& x, Index node_count, const Box<3>& box,
             const CompressedRows& corners);

  std::vector<Index> nodes;     ///< nodes of the mesh in the order
  std::vector<Index> elements;  ///< elements of the mesh in the order
  CompressedRows corners;       ///< of elements; elements and nodes by their numbers in the order
};

class HalfEdgeMesh;
class Topology;

/// The edge neighbours of each node and the elements around it (#nodes rows). Rows of unused nodes
/// are empty.
struct NodeStars {
  CompressedRows neighbours, elements;
};

/// The stars of a plane or surface mesh, in the order of Topology::neighbours(). elements: those of
/// the half-edge mesh. Throws MeshError naming a node with two separate stars.
NodeStars surface_stars(const HalfEdgeMesh& mesh, const CompressedRows& elements);

/// The elements around each node of a volume mesh, ascending. elements: their corners.
CompressedRows star_rows(const CompressedRows& elements, Index node_count);

/// The elements around each node of a volume mesh, by the numbers of a CurveOrder.
struct OrderedStars {
  /// topology: with its oriented elements.
  OrderedStars(const MeshData& data, const Topology& topology);

  /// The shape of an element, by its number in the order.
  const ElementShape& shape(Index k) const;

  CurveOrder order;
  CompressedRows elements;  ///< around nodes
  std::vector<ElementType> types;
  const Topology* topology;
};

/// Edge neighbours of each node of the mesh, ascending.
CompressedRows volume_neighbours(const OrderedStars& stars);

/// Boundary loops of a plane or surface mesh, elements on the left. Each starts at its lowest node,
/// and they are in the order of these nodes.
std::vector<std::vector<Index>> boundary_loops(const HalfEdgeMesh& mesh);

/// Throws MeshError naming a node of a plane or surface mesh at which more than two boundary edges
/// meet.
void check_surface_manifold(const MeshData& data, const FacePairs& pairs);

/// Throws MeshError naming a node of a volume mesh whose star is neither a ball nor, on the
/// boundary, a half ball: parts of the mesh or of its boundary meet in this node or in an edge
/// only. In a mesh with polyhedra nodes on the boundary may do so. topology: with its faces and
/// neighbours. pairs: its faces, with the elements as the file has them. turned: the elements of
/// the topology that were turned since (#elements).
void check_volume_manifold(const Topology& topology, const OrderedStars& stars,
                           const FacePairs& pairs, const std::vector<bool>& turned);

/// Throws MeshError for a boundary triangle of one element that covers half of a boundary
/// quadrilateral of another. In a mesh with polyhedra, another triangle has to cover the other
/// half.
void check_matching_faces(const Topology& topology);

}  // namespace winslow
