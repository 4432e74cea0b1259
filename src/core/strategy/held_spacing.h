#pragma once

#include "core/geometry/curve.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/problem/node_classes.h"
#include "core/strategy/slide_options.h"

namespace winslow {

/// Whether a marker counts as a wall, along which the spacing of nodes matters. It does
///
/// - in the plane, if it lies around a body (find_walls());
/// - anywhere, if at least half of the elements at it are three times as long along it as high.
///
/// Throws UsageError for a marker that the mesh does not have.
bool is_wall(const Mesh& mesh, const std::string& marker);

using CurveRows = std::vector<std::shared_ptr<const CurveRow>>;

/// Holds the spacing of nodes along the curves of sliding markers, as the options say. The ends of
/// a curve decide what the nodes between them do:
///
/// - An end has unknowns of its own: the nodes between follow it (NodeClasses::set_following()). On
///   a closed curve one node has unknowns, and all others follow it.
/// - No end has unknowns, and a motion moves one of them: the nodes between go with the motion.
/// - Both ends stay: so do the nodes between.
///
/// Sets boundary.sliding to what became of each curve. Call it after all other classes are set.
///
/// Nodes that follow have no unknowns: the spacing is held by elimination, not by a term of the
/// energy. So each edge of a curve keeps its share of the curve's length to round-off.
///
/// Returns the rows that go with the motion. Their nodes are prescribed.
CurveRows hold_spacing(const SlideOptions& slide, const Mesh& mesh, MovingBoundary& boundary,
                       NodeClasses& classes);

/// A motion that also moves the rows which go with it. `motion` must outlive the result.
std::unique_ptr<const Motion> with_rows(const Motion& motion, const CurveRows& rows);

}  // namespace winslow
