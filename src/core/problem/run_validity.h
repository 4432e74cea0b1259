#pragma once

#include <vector>

#include "core/problem/node_classes.h"
#include "core/quality/validity.h"

namespace winslow {

/// Reference normals of the elements of a surface mesh at x; empty where the classes have none.
std::vector<Vec3> element_normals(const NodeClasses& classes, const Coordinates& x, int threads);

/// check_validity() of the mesh of a run: elements of a surface mesh by the reference normals.
Validity check_validity(const NodeClasses& classes, const Coordinates& x, int threads);

}  // namespace winslow
