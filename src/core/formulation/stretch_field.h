#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// How far each element keeps its own shape when the mesh is smoothed with `auto` targets. The
/// stretch of an element is
///
///   s = log(s1 / s2) / 2,
///
/// with the singular values s1 >= s2 of the linear map from the regular element (equilateral
/// triangle; square, to the parallelogram of the mean edges) to the element: 0 if it is regular,
/// log(2) if it is four times as long as wide. Where elements are stretched like their neighbours,
/// the stretching counts as deliberate: m is the median of s over the elements of the same type
/// that share a node with this one, itself included.
///
/// - Triangles keep the share step(m; 0.45, 0.8), where step is the cubic that rises from 0 to 1.
///   The share spreads over three rows of elements, so that it does not jump where layers end.
/// - Quadrilaterals keep all of their shape where the grid is regular. A structured grid has
/// squares
///   only where its spacings happen to be equal; square targets there would bend the lines beside
///   them. Where the grid is rough (BoxField: jittered, or unstructured), the target becomes a
///   rectangle: the own shape has the share 1 - step(roughness; 0.025, 0.05). The sides of the
///   rectangle are the mean ones of the neighbours along the same grid lines. With r the stretch of
///   this mean, their ratio is raised to the power step(r; 0.2, 0.45), so that it is a square where
///   the mesh is isotropic.
/// - A triangle at the boundary keeps at least 1 - step(s; 0, 0.2), and has twice the weight if
///   that is 1: a well-shaped triangle keeps its height over the wall.
/// - An element that keeps a stretch s, with the aspect ratio exp(2 s), has the weight
///   exp(2 s) / 4, at least 1, at most 300. So layers at walls keep their heights where a passage
///   becomes narrower, and the elements between them give way.
/// - No target is stretched by more than m + 0.35 (triangle) or m + 0.7 (corner of a
///   quadrilateral): slivers get the stretch of their neighbours.
///
/// In space s = log(s1 / s3) / 2, the mean over the element's corners, each relative to that of the
/// regular element of its type. Tetrahedra are treated like triangles; prisms and hexahedra like
/// quadrilaterals, with right prisms over equilateral triangles and with boxes in the place of
/// rectangles. Pyramids keep all of their shape. Nothing is held at the boundary.
///
/// Where elements of several types meet in space, a hexahedron counts 8.5 times as much as a
/// tetrahedron and a prism 3.7 times: these are their volumes if all edges are as long. With one
/// weight for each, a hexahedron would give way to the six or more tetrahedra in its room. A
/// pyramid counts thirty times: around its apex lie some twenty tetrahedra, which would flatten it.
///
/// The target is the element's own shape with its stretch, relative to the regular shape or to the
/// box, multiplied by the share and limited as above. Next to an inverted element a shape is
/// meaningless: the share is 0 there, and everywhere if more than one element in twenty is
/// inverted.
struct StretchField {
  std::vector<double> share;  ///< #elements, 0 (regular) to 1 (its own shape)
  std::vector<double>
      longest;  ///< #elements: largest permitted stretch of a target, where share is not 0
  /// #elements: BoxField::sides of the shape to which the share 0 leads; 0: the regular shape.
  /// Empty: regular everywhere.
  std::vector<Vec3> sides;
  std::vector<double> weight;     ///< #elements: weight factor at the boundary
  std::vector<double> stiffness;  ///< #elements: weight factor for stretched elements
  /// Fraction of all elements (0 to 1) that are at least twice as long as wide and keep most of it.
  double stretched = 0;
};

/// threads: 0 for all cores; no result depends on it. normals: of a surface mesh, the reference
/// normals of its elements (ElementNormals), which say which are inverted.
StretchField stretch_field(const Topology& topology, const Coordinates& given, int threads,
                           std::span<const Vec3> normals = {});

}  // namespace winslow
