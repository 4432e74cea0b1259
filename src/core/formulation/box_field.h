#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// How irregular a mesh is at its quadrilaterals, hexahedra and prisms, and the right-angled shapes
/// ("boxes") that these elements can take instead of their own.
///
/// The shape of an element is described in its own axes, by its mean edges: the logarithms of the
/// ratios of their lengths, and the angles between them. A neighbour of the same type across a face
/// is seen in the axes of the element. So it does not matter how grid lines turn in space, as at
/// the nose of an O-grid. The unit is that of the stretch s of StretchField.
///
/// A grid that was made on purpose changes monotonically along its lines, whether it is graded,
/// curved or skewed. There every number is the median of those of the element and its neighbours.
/// In a jittered or an unstructured mesh it is not. (Beside the boundary, where lines end, two
/// medians are taken, with and without the neighbours on the one side. The nearer one counts.) The
/// roughness of an element is the difference from these
/// medians, averaged over three rows of elements; at least a quarter of its own difference. Prisms,
/// whose triangles have no axes, differ from their neighbours by the ratio of height to triangle,
/// and from those in their column by the shape of the triangle.
struct BoxField {
  std::vector<double> roughness;  ///< #elements; 0 for those of other types
  /// #elements: logarithms of the sides of the box along the axes of the element (those of
  /// regular_corners(); the sum is 0), smoothed over its neighbours; 0 for other types. Empty if no
  /// element is rougher than `smooth`.
  std::vector<Vec3> sides;
};

/// Whether elements of a type have boxes.
bool has_box(ElementType type);

/// given: the mesh; shapes of inverted elements have no meaning. smooth: see BoxField::sides.
/// threads: 0 for all cores; no result depends on it.
BoxField box_field(const Topology& topology, const Coordinates& given, double smooth, int threads);

}  // namespace winslow
