#pragma once

#include <map>

#include "core/geometry/curve_row.h"
#include "core/geometry/periodic_pairs.h"
#include "core/geometry/sliding_geometry.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// What counts as a feature of a boundary, and which of its nodes slide.
struct FeatureRules {
  double angle = 40;             ///< degrees by which a boundary turns at a corner or an edge
  bool slide_along = false;      ///< in space nodes slide along feature lines, too
  std::vector<Index> hold = {};  ///< nodes that stay, whatever was found of them
  /// Nodes at which the boundary counts as smooth, however much it turns: they slide on the curve
  /// or the surface through them.
  std::vector<Index> smooth = {};

  bool operator==(const FeatureRules&) const = default;
};

/// A surface of one's own, for the boundary of a mesh in space to slide on:
///
///     auto surface = std::make_shared<winslow::ReferenceSurface>();
///     surface->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
///     surface->faces = {winslow::Face(0, 1, 2)};

/// A surface that is given besides a mesh, for the nodes of the mesh to slide on: finer than the
/// mesh as a rule, from CAD or a scan. Lengths in the unit of the mesh.
struct ReferenceSurface {
  std::string source;  ///< name of the file, for messages
  std::vector<Vec3> points;
  std::vector<Face> faces;  ///< triangles and quadrilaterals, of points
};

/// The same, `origin` subtracted from its points.
std::shared_ptr<const ReferenceSurface> moved_to(const ReferenceSurface& surface,
                                                 const Vec3& origin);

/// What the nodes of a run slid on is part of its result:
///
///     for (const winslow::SlidingPart& part : result.smooth.boundary.sliding)
///       std::printf("%s: %s\n", part.marker.c_str(), part.description.c_str());

/// What becomes of the spacing of nodes along a curve: of the shares that the edges have of the
/// length of their stretch.
enum class Spacing {
  free,   ///< nodes slide one by one
  turns,  ///< held: a closed curve, which turns as a whole
  ends,   ///< held, between ends of which one at least moves
  stays   ///< held, between ends that stay: so do all nodes
};

/// What is said of it behind the description of a curve: ", spacing held", ...; nothing of `free`.
std::string text_of(Spacing spacing);

/// A stretch of a marker's boundary without features, as it was recognised.
struct SlidingPart {
  std::string marker;
  std::string description;   ///< "straight line", "circle of radius 10", "plane", "straight edge"
  std::vector<Index> nodes;  ///< those that slide on it
  /// Of a curve all its nodes, its ends too; null of a surface, and of curves of a reference
  /// surface.
  std::shared_ptr<const CurveRow> row = {};
  Spacing spacing = Spacing::free;  ///< as a run found it (hold_spacing())

  std::size_t sliding_nodes() const { return spacing == Spacing::stays ? 0 : nodes.size(); }
};

/// What the nodes of some markers slide on, from the mesh as given, and which of them do.
///
/// In the plane a marker is cut at its features: where it turns by more than the feature angle,
/// ends or meets the rest of the boundary. The nodes there stay; the others slide on the curve
/// through their stretch (curve_through()).
///
/// In space the faces of the markers, or the elements of a surface mesh, are cut into regions at
/// their features (find_features()). A node inside a region slides on the surface through it
/// (surface_through()); one on a feature line stays, or slides along the curve through the line,
/// and corners stay, as do nodes that meet the rest of the boundary.
///
/// On a reference surface features, curves and surfaces are those of that surface. Edges of the
/// mesh that run along one of its feature lines are what the faces of the markers are cut by
/// (ReferenceLines); borders and edges between markers cut them, too, and stay where they run along
/// none. The nodes between slide on those regions of it to which their part of the mesh is nearest.
///
/// Single nodes can be told from what the feature angle makes of them: FeatureRules::hold, smooth.
///
/// Where a periodic side meets the boundary that slides, and nothing else, its node slides, too, if
/// that boundary goes on beyond as the periodic image of where it comes back: in the plane on the
/// curve through its stretch and the image of that on which its partner lies, in space on a plane,
/// a cylinder or a sphere. If it turns there by more than the feature angle, or is another surface,
/// the node stays.
struct SlidingBoundary {
  std::vector<SlidingPart> parts;
  /// Of the corners of the periodic sides those that slide: the first of each in parts.
  std::vector<PeriodicPair> corners = {};
  std::shared_ptr<const SlidingGeometry> geometry;
  /// Nodes that stay because of the feature angle alone, ascending: FeatureRules::smooth would have
  /// them slide.
  std::vector<Index> bends;
  /// Nodes that stay, but not where they are: the ends of feature lines of a reference surface.
  std::map<Index, Vec3> places = {};

  /// markers: names; none of a surface mesh, all of whose nodes take part. reference: a surface to
  /// slide on instead of the mesh's own, which the nodes need not lie on (put_on()). periodic: the
  /// sides whose corners may slide. Throws UsageError for markers that the mesh does not have and
  /// those of which no node can slide, for nodes of the rules that it does not have, or that cannot
  /// be smooth since feature lines end or meet there, for a reference surface of a plane mesh, or
  /// one that is not where the nodes are, and, naming the two nodes, for a corner whose image is on
  /// a marker that does not slide or in space not on the image of its surface.
  static SlidingBoundary find(const Topology& topology, const Coordinates& x,
                              std::span<const std::string> markers, const FeatureRules& rules,
                              const ReferenceSurface* reference = nullptr,
                              std::span<const PeriodicPairs> periodic = {});
};

/// The nodes that slide put where they lie nearest to on what they slide on, and those that have a
/// place there.
Coordinates put_on(const SlidingBoundary& boundary, Coordinates x);

}  // namespace winslow
