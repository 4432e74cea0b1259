#pragma once

#include "core/geometry/curve.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/problem/node_classes.h"
#include "core/strategy/mesh_state.h"
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

/// What a run of a volume mesh begins from: its sliding nodes on the reference surface of its
/// options.
struct ReferenceStart {
  MeshState state;
  /// As RunOptions::start; none where there was none, and where it would have inverted elements.
  std::optional<Coordinates> start;
};

/// Puts the nodes that slide onto the reference surface. Throws UsageError for one that nothing
/// slides on.
ReferenceStart put_on_reference(const ResolvedSlide& slide, const MeshState& state,
                                const Coordinates* start);

/// A motion leads through valid meshes. Throws UsageError where nodes that were put onto the
/// surface have inverted elements of the mesh.
void require_no_more_inverted(const SlideOptions& slide, const Mesh& before, const Mesh& placed);

}  // namespace winslow
