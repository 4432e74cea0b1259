#pragma once

#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/problem/node_classes.h"
#include "core/strategy/slide_options.h"

namespace winslow {

/// A body that stands on a boundary that slides may move along it: what it stands on gives way on
/// one side of it and follows on the other, so that nothing of it is in the body's way. Sets
/// boundary.yielding. Throws UsageError, naming the first node, where the motion takes the foot of
/// the body off the line, circle, plane, cylinder or sphere that it stands on; other curves and
/// surfaces are known only where the mesh has nodes of them.
void let_bodies_slide(const Mesh& mesh, const Motion& motion, const NodeClasses& classes,
                      MovingBoundary& boundary);

/// Nodes of the boundary that give way to a body that moves, so that nothing touches their edges
/// and faces: those of periodic pairs, and boundary.yielding. Ascending.
std::vector<Index> yielding_nodes(const MovingBoundary& boundary, const NodeClasses& classes);

}  // namespace winslow
