#pragma once

#include "core/geometry/curve.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/problem/node_classes.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/slide_options.h"
#include "core/strategy/smooth_options.h"

namespace winslow {

/// Whether a marker counts as a wall, along which the spacing of nodes matters. It does
///
/// - in the plane: if it lies around a body (find_walls());
/// - anywhere: if at least half of its elements are at least three times as long along it as high.
///
/// Throws UsageError for a marker that the mesh does not have.
bool is_wall(const Mesh& mesh, const std::string& marker);

using CurveRows = std::vector<std::shared_ptr<const CurveRow>>;

/// Holds the spacing of nodes along the curves of sliding markers, as the options say. The ends of
/// a curve determine the motion of the nodes between them:
///
/// - An end has its own unknowns: the nodes between follow it (NodeClasses::set_following()). On a
/// closed curve one node has unknowns, and all others follow it.
/// - No end has unknowns, and a motion moves one of them: the nodes between move with the motion.
/// - Both ends are fixed: so are the nodes between.
///
/// Updates boundary.sliding with the result for each curve. Call it after all other classes are
/// set.
///
/// Nodes that follow have no unknowns: the spacing is held by elimination, not by a term of the
/// energy. So each edge of a curve keeps its share of the curve's length to round-off.
///
/// Returns the rows that move with the motion. Their nodes are prescribed.
CurveRows hold_spacing(const SlideOptions& slide, const Mesh& mesh, MovingBoundary& boundary,
                       NodeClasses& classes);

/// Returns `motion` extended to the rows that move with it. `motion` must outlive the result.
std::unique_ptr<const Motion> with_rows(const Motion& motion, const CurveRows& rows);

/// Lets the boundary on which moving bodies stand give way: the nodes of each part of a fixed
/// marker (find_footholds()) that is a straight line, a circle, a plane, a cylinder or a sphere
/// slide, and so do those of straight or circular edges between two such parts. Does so for markers
/// that neither slide nor are periodic by themselves, except SlideOptions::fixed. held_by: what
/// holds all of them; empty: nothing. Adds to boundary.sliding, and sets boundary.footholds and
/// boundary.held_footholds. Call it before let_bodies_slide().
void let_footholds_slide(const SlideOptions& slide, const std::string& held_by, const Mesh& mesh,
                         const BodyNodes& bodies, MovingBoundary& boundary, NodeClasses& classes);

/// What bodies stand on: what gives way to them, as in let_footholds_slide(), and parts of markers
/// that slide by themselves on the shapes of the mesh.
std::vector<Foothold> footholds_of(const SlideOptions& slide, const std::string& held_by,
                                   const Mesh& mesh, const BodyNodes& bodies);

/// What keeps the boundary under bodies from giving way, in the words of HeldFoothold; empty:
/// nothing.
std::string what_holds_footholds(const SmoothOptions& options);

/// Throws UsageError if the motion moves the nodes of bodies off what they stand on, or if this is
/// a curve or a surface that is known only at the mesh nodes. The message names the markers, the
/// number of nodes and what to do.
void require_on_footholds(const Mesh& mesh, const Motion& motion,
                          std::span<const Foothold> footholds);

/// The nodes of a motion, and those that change their places.
BodyNodes body_nodes(const Motion& motion, const Coordinates& rest);
/// The markers that move where these nodes (ascending) move: those all of whose nodes are among
/// them, which are bodies, and those of which they move whole faces. Faces between bodies do not
/// count, as on the floor of a gap that is one element wide.
std::vector<std::string> markers_moved_by(const Topology& topology, std::span<const Index> nodes);
/// The same as body_nodes() for nodes that a table names one by one: they are a body only where
/// whole faces of the boundary move, and do not stand on markers_moved_by() them.
BodyNodes body_nodes_of_table(const Motion& motion, const Mesh& rest);

/// Lets a body that stands on a sliding boundary move along it: the nodes of this boundary give way
/// on one side of the body and follow on the other. Sets boundary.yielding. Throws UsageError,
/// naming the first node, if the motion moves the foot of the body off the line, circle, plane,
/// cylinder or sphere on which it stands; other curves and surfaces are known only at the mesh
/// nodes.
void let_bodies_slide(const Mesh& mesh, const Motion& motion, const NodeClasses& classes,
                      MovingBoundary& boundary);

/// The fixed marker at the place of damage, which may be less if its nodes slide: it neither moves
/// nor slides nor is periodic, and no moving marker shares nodes with it. Empty if there is none.
std::string fixed_marker_at(const Topology& topology, const Damage& damage,
                            std::span<const std::string> moving, const SlideOptions& slide);

/// Boundary nodes that give way to a moving body, so contact ignores their edges and faces: those
/// of periodic pairs, and boundary.yielding. Ascending.
std::vector<Index> yielding_nodes(const MovingBoundary& boundary, const NodeClasses& classes);

/// The initial meshes of a run on a volume mesh, with the sliding nodes on the reference surface.
struct ReferenceStart {
  MeshState state;
  /// As RunOptions::start; none if there was none, or if it would have inverted elements.
  std::optional<Coordinates> start;
};

/// Projects the sliding nodes onto the reference surface. Throws UsageError for a reference surface
/// on which no node slides.
ReferenceStart put_on_reference(const ResolvedSlide& slide, const MeshState& state,
                                const Coordinates* start);

/// Throws UsageError if the projection of nodes onto the surface has inverted elements: a motion
/// needs a valid mesh.
void require_no_more_inverted(const SlideOptions& slide, const Mesh& before, const Mesh& placed);

}  // namespace winslow
