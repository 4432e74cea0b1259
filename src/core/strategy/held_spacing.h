#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/geometry/curve_row.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/problem/node_classes.h"
#include "core/strategy/slide_options.h"

namespace winslow {

/// Whether a marker is taken for a wall, whose spacing along the boundary matters: in the plane one
/// that lies around a body (find_walls()), and any one of whose elements half or more are three
/// times as long along it as they are high. Throws UsageError for a marker that there is not.
bool is_wall(const Mesh& mesh, const std::string& marker);

using CurveRows = std::vector<std::shared_ptr<const CurveRow>>;

/// Holds the spacing along the curves of sliding markers as the options say: between ends of which
/// one moves by unknowns of its own the nodes follow (NodeClasses::set_following()), as they do on
/// a closed curve, on which one node leads; between a body that the motion takes and another end
/// they go with the motion; between ends that stay they stay. What became of each curve is said in
/// boundary.sliding. To be called after all other classes are set.
///
/// It is elimination, and no term of the energy: whatever the mesh does, shares are those of the
/// mesh as given, to round-off.
///
/// Returns the rows that go with the motion; their nodes are prescribed.
CurveRows hold_spacing(const SlideOptions& slide, const Mesh& mesh, MovingBoundary& boundary,
                       NodeClasses& classes);

/// A motion, and the rows that go with it. The motion has to outlive it.
std::unique_ptr<const Motion> with_rows(const Motion& motion, const CurveRows& rows);

}  // namespace winslow
