#pragma once

#include "core/mesh/mesh.h"

/// Surfaces in volume meshes, as faces of elements, and surface meshes.
namespace winslow {

/// A face of an element, seen from outside it counter-clockwise.
struct SurfaceFace {
  Face nodes;
  Index element = -1;
  Index neighbour = -1;  ///< the element beyond; -1 on the boundary
  Index marker = -1;     ///< index into Topology::markers(); -1: none
};

/// The boundary of a volume mesh, and the faces of markers that lie inside (once each); of a
/// surface mesh all of its elements.
std::vector<SurfaceFace> boundary_faces(const Topology& topology);

/// What bounds some elements of a volume mesh: their faces beyond which none of them lies. Closed.
/// Of a surface mesh those elements themselves.
/// chosen: not 0 for each of them (#elements). Markers are not looked up.
std::vector<SurfaceFace> outer_faces(const Topology& topology,
                                     std::span<const unsigned char> chosen);

/// Edges of a surface, each once, with the faces that it bounds.
struct SurfaceEdges {
  std::vector<std::array<Index, 2>> nodes;  ///< lower node first; ascending
  CompressedRows faces;                     ///< per edge: indices of faces, ascending
};
SurfaceEdges surface_edges(std::span<const SurfaceFace> faces);

/// Vector of a face's area, its normal on the side from which it is counter-clockwise; of a
/// quadrilateral half the cross product of its diagonals.
Vec3 area_vector(const SpacePoints& x, const Face& face);
Vec3 centre_of(const SpacePoints& x, const Face& face);  ///< mean of the corners
/// Unit normal of a surface mesh at a node: the sum of the areas of the elements around, as
/// vectors; zero where they have none.
Vec3 star_normal(const Topology& topology, const SpacePoints& x, Index node);

/// Which edges show the form of a surface (#edges, 1 or 0): those of one face alone or of more than
/// two, those at which two faces turn by more than this angle (degrees), and those between two
/// markers.
std::vector<unsigned char> feature_edges(const SpacePoints& x, std::span<const SurfaceFace> faces,
                                         const SurfaceEdges& edges, double angle);

}  // namespace winslow
