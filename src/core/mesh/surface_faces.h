#pragma once

#include "core/mesh/mesh.h"

/// Surfaces as lists of faces: the boundary and parts of volume meshes, and surface meshes.
namespace winslow {

/// A face of an element, counter-clockwise seen from outside the element.
struct SurfaceFace {
  Face nodes;
  Index element = -1;
  Index neighbour = -1;  ///< the element beyond; -1 on the boundary
  Index marker = -1;     ///< index into Topology::markers(); -1: none
};

/// The boundary faces of a volume mesh and the faces of markers inside it, each once. For a surface
/// mesh, all elements.
std::vector<SurfaceFace> boundary_faces(const Topology& topology);
/// The same with other markers than those of the topology.
std::vector<SurfaceFace> boundary_faces(const Topology& topology, const Markers& markers);

/// The closed surface around chosen elements of a volume mesh: the faces that belong to only one of
/// them. For a surface mesh, the chosen elements themselves. chosen: not 0 for a chosen element
/// (#elements). The faces have no markers.
std::vector<SurfaceFace> outer_faces(const Topology& topology,
                                     std::span<const unsigned char> chosen);

/// The edges of a surface, each once, with the faces at each edge.
struct SurfaceEdges {
  std::vector<std::array<Index, 2>> nodes;  ///< lower node first; ascending
  CompressedRows faces;                     ///< per edge: indices of faces, ascending
};
SurfaceEdges surface_edges(std::span<const SurfaceFace> faces);

/// Area vector of a face: its length is the area, and it points to the side from which the face is
/// counter-clockwise. It depends on the edges alone, also of a face that is not plane; for a
/// quadrilateral it is half the cross product of the diagonals.
Vec3 area_vector(const SpacePoints& x, const Face& face);
Vec3 centre_of(const SpacePoints& x, const Face& face);  ///< mean of the corners
/// Unit normal of a surface mesh at a node, along the sum of the area vectors of the elements
/// around; zero if that sum is zero.
Vec3 star_normal(const Topology& topology, const SpacePoints& x, Index node);

/// Which edges are features of a surface (#edges, 1 or 0): edges with one face or more than two,
/// edges at which two faces turn by more than this angle (degrees), and edges between two markers.
std::vector<unsigned char> feature_edges(const SpacePoints& x, std::span<const SurfaceFace> faces,
                                         const SurfaceEdges& edges, double angle);

}  // namespace winslow
