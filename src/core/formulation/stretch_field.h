#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// How much of its own shape each element of a mesh keeps when the mesh is smoothed with `auto`
/// targets. The stretch of an element is
///
///   s = log(s1 / s2) / 2,
///
/// s1 >= s2 being the singular values of the linear map from the regular element (equilateral
/// triangle; square, to the parallelogram of the mean edges) to it: 0 if it is regular, log(2) if
/// it is four times as long as wide. Meshes are stretched on purpose where elements are stretched
/// like their neighbours: m is the median of s over the elements of the same type that share a node
/// with this one, itself included.
///
/// - Triangles keep the share step(m; 0.45, 0.8), the cubic that rises from 0 to 1. It is spread
/// over
///   three rows of elements, so that it does not jump where layers end.
/// - Quadrilaterals keep all of their shape: a structured grid has squares only where its spacings
///   happen to cross, and to leave them square would bend the lines beside them.
/// - A triangle at the boundary keeps at least 1 - step(s; 0, 0.2), and counts twice as much if
///   that is 1: what is well shaped there keeps its height over the wall.
/// - An element that keeps a stretch s, with the aspect ratio exp(2 s), counts exp(2 s) / 4 times
/// as
///   much as others, at least once, at most 300 times. Where a passage becomes narrower, layers at
///   walls keep their heights so, and the elements between them give way.
/// - No target is stretched by more than m + 0.35 (triangle) or m + 0.7 (corner of a
/// quadrilateral):
///   slivers take on the stretch of their neighbours.
///
/// In space s = log(s1 / s3) / 2, the mean over the element's corners, each against that of the
/// regular element of its type; tetrahedra take the part of triangles, prisms, hexahedra and
/// pyramids that of quadrilaterals, and nothing is held at the boundary.
///
/// The target is the element's own shape with its stretch multiplied by all this. Next to an
/// inverted element a shape says nothing: the share is 0 there, and everywhere if more than one
/// element in twenty is inverted.
struct StretchField {
  std::vector<double> share;  ///< #elements, 0 (regular) to 1 (its own shape)
  std::vector<double>
      longest;  ///< #elements: largest stretch that a target may have, where share is not 0
  std::vector<double> weight;  ///< #elements: how much more than others it counts at the boundary
  std::vector<double> stiffness;  ///< #elements: and how much more as one that is stretched
  /// Part of all elements (0 to 1) that are twice as long as wide, or more, and keep most of it.
  double stretched = 0;
};

/// threads: 0 for all cores; no result depends on it. normals: of a surface mesh, the reference
/// normals of its elements (ElementNormals), which say which are inverted.
StretchField stretch_field(const Topology& topology, const Coordinates& given, int threads,
                           std::span<const Vec3> normals = {});

}  // namespace winslow
