#pragma once

#include <map>

#include "core/geometry/curve.h"
#include "core/geometry/periodic_pairs.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// Orthonormal directions in which a node may move, one for each unknown. In the plane their third
/// component is zero.
class TangentFrame {
 public:
  TangentFrame() = default;
  /// The coordinate axes.
  static TangentFrame axes(int dimension);
  void add(const Vec3& direction) { directions_[static_cast<std::size_t>(count_++)] = direction; }

  int count() const { return count_; }
  const Vec3& operator[](int k) const { return directions_[static_cast<std::size_t>(k)]; }
  const Vec3* begin() const { return directions_.data(); }
  const Vec3* end() const { return directions_.data() + count_; }

  bool operator==(const TangentFrame&) const = default;

 private:
  std::array<Vec3, 3> directions_{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  int count_ = 0;
};

/// The foot of a point on a curve or a surface: the nearest point, with tangents and curvature. To
/// second order, a node that moves by u_k along the directions of the frame and is then put back
/// onto the geometry comes to
///
///   point + sum_k u_k frame_k + 1/2 sum_kl u_k u_l bend_kl.
///
/// The bends are at right angles to the frame: the curvature vector of a curve, the second
/// fundamental form of a surface. Lengths are in units of the mesh, bends in 1 / that.
struct Foot {
  Vec3 point{0, 0, 0};
  TangentFrame frame;  ///< one direction of a curve, two of a surface
  std::array<Vec3, 3> bend{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};  ///< 11, 12, 22
};

/// The curves and surfaces on which nodes slide. They never change, and results depend on the
/// arguments alone.
class SlidingGeometry {
 public:
  virtual ~SlidingGeometry() = default;
  /// The foot of a point on the curve or surface of a node. Frames of near feet are near to each
  /// other. Throws UsageError for a node that does not slide.
  virtual Foot foot(Index node, const Vec3& point) const = 0;
};

/// A cache of the last two feet of each node. A step of a solver needs the feet in its first mesh
/// and in the tried mesh many times, and a search in a triangulation is slow. The foot of a point
/// that is a foot itself is the same foot, bit by bit.
///
/// Several threads may ask for different nodes at the same time, but not for the same node. It is
/// for one run.
class RememberedFeet final : public SlidingGeometry {
 public:
  RememberedFeet(std::shared_ptr<const SlidingGeometry> geometry, Index node_count)
      : geometry_(std::move(geometry)), memory_(at(node_count)) {}

  Foot foot(Index node, const Vec3& point) const override;

 private:
  struct Place {
    Vec3 asked_for{0, 0, 0};
    Foot foot;
    bool known = false;
  };
  struct Memory {
    std::array<Place, 2> places;
    std::size_t last = 0;  // the place of the last call
  };

  std::shared_ptr<const SlidingGeometry> geometry_;
  mutable std::vector<Memory> memory_;
};

/// What nodes do in which regions of the mesh meet (Topology::interfaces()).
enum class Interfaces {
  automatic,  ///< held while a mesh is smoothed, free in a motion
  held,       ///< stay where they are
  slide,      ///< slide along the curve or the surface that the mesh has there
  free        ///< as any other node
};

/// Rules for features of a boundary and for the nodes that slide.
struct FeatureRules {
  double angle = 40;             ///< degrees by which a boundary turns at a corner or an edge
  bool slide_along = false;      ///< in space nodes slide along feature lines, too
  std::vector<Index> hold = {};  ///< nodes that stay in any case
  /// Nodes at which the boundary counts as smooth, whatever its angle: they slide on the curve or
  /// the surface through them.
  std::vector<Index> smooth = {};
  /// `held`, `automatic`: parts of the boundary end where regions meet. `slide`: they do, and the
  /// nodes inside a plane or volume mesh in which regions meet slide, too. In a surface mesh the
  /// nodes in which regions meet stay or slide.
  Interfaces interfaces = Interfaces::free;

  bool operator==(const FeatureRules&) const = default;
};

/// A reference surface, on which the boundary of a mesh in space slides:
///
///     auto surface = std::make_shared<winslow::ReferenceSurface>();
///     surface->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
///     surface->faces = {winslow::Face(0, 1, 2)};

/// A surface from CAD or a scan on which the nodes of a mesh slide, usually finer than the mesh.
/// Lengths are in units of the mesh.
struct ReferenceSurface {
  std::string source;  ///< name of the file, for messages
  std::vector<Vec3> points;
  std::vector<Face> faces;  ///< triangles and quadrilaterals, of points
};

/// The surface with `origin` subtracted from its points.
std::shared_ptr<const ReferenceSurface> moved_to(const ReferenceSurface& surface,
                                                 const Vec3& origin);

/// The result of a run has the curves and surfaces on which nodes slid:
///
///     for (const winslow::SlidingPart& part : result.smooth.boundary.sliding)
///       std::printf("%s: %s\n", part.marker.c_str(), part.description.c_str());

/// What a run does with the spacing of nodes along a curve: the share of each edge in the length of
/// the row.
enum class Spacing {
  free,   ///< nodes slide one by one
  turns,  ///< held on a closed curve: all nodes move together around it
  ends,   ///< held between ends of which at least one moves
  stays   ///< held between ends that stay, so that all nodes stay
};

/// The text after the description of a curve: ", spacing held", ...; empty for `free`.
std::string text_of(Spacing spacing);

/// A part of a marker without features, with its recognised curve or surface.
struct SlidingPart {
  std::string marker;        ///< name of the marker, or of the interface (Topology::name_of())
  std::string description;   ///< "straight line", "circle of radius 10", "plane", "straight edge"
  std::vector<Index> nodes;  ///< nodes that slide on it
  /// All nodes of a curve with its ends; null for surfaces and for curves of a reference surface.
  std::shared_ptr<const CurveRow> row = {};
  Spacing spacing = Spacing::free;  ///< as a run found it (hold_spacing())
  bool of_regions = false;          ///< where two regions meet: no part of a marker
  bool goes_on = false;             ///< a straight line or a circle of a plane mesh
  bool gives_way = false;           ///< slides only because a moving body stands on it

  std::size_t sliding_nodes() const { return spacing == Spacing::stays ? 0 : nodes.size(); }
};

/// The nodes of some markers that slide, and the curves and surfaces on which they slide.
///
/// In the plane a marker is cut at its features: where it turns by more than the feature angle,
/// ends or meets the rest of the boundary. The nodes there stay. The others slide on the curve
/// through their part (curve_through()).
///
/// In space the faces of the markers, or the elements of a surface mesh, are cut into regions at
/// their features (find_features()). A node inside a region slides on the surface through the
/// region (surface_through()). A node on a feature line stays, or slides along the curve through
/// the line. Corners and nodes on the rest of the boundary stay.
///
/// With a reference surface, features, curves and surfaces are those of the reference surface. The
/// faces of the markers are cut along mesh edges that follow its feature lines (ReferenceLines), at
/// borders and between markers. Nodes on cuts that are on no feature line stay. The nodes between
/// the cuts slide on the regions of the reference surface that are nearest to their part of the
/// mesh.
///
/// Where regions meet (FeatureRules::interfaces), the faces between two of them are as a marker of
/// their own inside the mesh. They are cut at their features, where they meet the boundary or a
/// marker, and where more than two regions meet. The nodes there stay.
///
/// FeatureRules::hold and FeatureRules::smooth override the feature angle for single nodes.
///
/// A corner of a periodic side that meets the sliding boundary and nothing else slides, too, if the
/// periodic image of the boundary at its partner continues the boundary. In the plane it slides on
/// the curve through its part and the image of the part of its partner, in space on a plane, a
/// cylinder or a sphere. If the boundary turns there by more than the feature angle, or its image
/// is another surface, the node stays.
struct SlidingBoundary {
  std::vector<SlidingPart> parts;
  /// Corners of periodic sides that slide. The first node of each pair is in `parts`.
  std::vector<PeriodicPair> corners = {};
  std::shared_ptr<const SlidingGeometry> geometry;
  /// Nodes that stay only because of the feature angle, ascending. FeatureRules::smooth would let
  /// them slide.
  std::vector<Index> bends;
  /// Fixed positions of nodes that do not slide: the ends of feature lines of a reference surface.
  std::map<Index, Vec3> places = {};

  /// markers: names; none for a surface mesh, whose elements all count. reference: a surface to
  /// slide on in place of the mesh's own; nodes need not lie on it (put_on()). periodic: sides
  /// whose corners may slide. Throws UsageError for
  /// - unknown markers and markers without a node that can slide,
  /// - unknown nodes of the rules, and smooth nodes at which feature lines end or meet,
  /// - a reference surface with a plane mesh, or one that is far from the nodes,
  /// - a corner whose image is on a marker that does not slide, or in space not on the image of its
  ///   surface; the message names both nodes.
  static SlidingBoundary find(const Topology& topology, const Coordinates& x,
                              std::span<const std::string> markers, const FeatureRules& rules,
                              const ReferenceSurface* reference = nullptr,
                              std::span<const PeriodicPairs> periodic = {});
};

/// Moves the nodes that slide to their feet, and nodes with a fixed position there.
Coordinates put_on(const SlidingBoundary& boundary, Coordinates x);

}  // namespace winslow
