#pragma once

#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/quality/metric.h"

namespace winslow {

struct WorstElement {
  Index element;
  double value;
  Vec3 centre;  ///< z is 0 in the plane
};

/// Mean of an element's corners, in units of the mesh: tells a user where to look. z is 0 in the
/// plane.
Vec3 element_centre(const Mesh& mesh, Index element);

/// The elements that a field finds worst, worst first, ties by index, no more than `count`; those
/// without a value (NaN) are left out. values: #elements.
std::vector<WorstElement> worst_elements(const Mesh& mesh, std::span<const double> values,
                                         const FieldInfo& field, int count);

}  // namespace winslow
