#pragma once

#include <set>

#include "core/geometry/sliding_boundary.h"
#include "core/geometry/surface/triangulation.h"
#include "core/geometry/surface_features.h"
#include "core/mesh/surface_faces.h"

namespace winslow {

/// A reference surface cut at its features, with searches for its lines and regions.
class ReferenceShape {
 public:
  /// angle: of features, in degrees. Throws UsageError for a surface without faces.
  ReferenceShape(const ReferenceSurface& given, double angle);

  const std::string& source() const { return source_; }

  Index line_count() const { return static_cast<Index>(features_.lines.size()); }
  /// The curve through a line, with straight continuations where the line fades out.
  const std::shared_ptr<const SpaceCurve>& curve(Index line) const {
    return curves_.curves[at(line)];
  }
  double length(Index line) const { return lengths_[at(line)]; }

  /// A point on a feature line.
  struct LinePlace {
    Index line;
    double distance;
    Vec3 tangent;  ///< unit vector along the chord there
  };
  /// The nearest feature line within `reach`.
  std::optional<LinePlace> nearest_line(const Vec3& point, double reach) const;
  /// The lines with a segment whose box is within `reach`, ascending: all lines within reach and
  /// perhaps some more.
  std::vector<Index> lines_about(const Vec3& point, double reach) const;

  /// The point of a line nearest to a point.
  struct LineFoot {
    Vec3 point;
    double distance;
    double arc;  ///< length from the start of the line
  };
  LineFoot foot_on_line(Index line, const Vec3& point) const;
  bool closed(Index line) const { return features_.lines[at(line)].closed; }

  /// Points where feature lines meet or turn, and tips of cones; not the points where a line fades
  /// out.
  const std::vector<Vec3>& corners() const { return corners_; }
  /// An end of an open line.
  struct LineEnd {
    Vec3 point;
    bool fades_out;  ///< no other line ends there, so it is no corner
  };
  std::array<LineEnd, 2> ends(Index line) const;

  struct SurfacePlace {
    Index region;
    double distance;
  };
  SurfacePlace nearest_region(const Vec3& point) const;
  /// Distance from the triangles of one region.
  double distance_to_region(Index region, const Vec3& point) const;
  /// The surface of some regions together (ascending, at least one).
  std::shared_ptr<const Surface> surface(const std::vector<Index>& regions) const;

 private:
  struct Segment {
    Vec3 a, b;
    Index line;
  };
  void add_line(Index line, const Chain& chain, const SpacePoints& x);
  void let_fade(Index line);

  std::string source_;
  std::vector<SurfaceFace> faces_;
  SurfaceFeatures features_;
  FeatureCurves curves_;
  std::vector<Segment> segments_;           // of all lines, line after line
  std::vector<std::size_t> first_segment_;  // #lines + 1
  std::vector<double> lengths_;
  BoxTree<3> segment_tree_;
  std::vector<Vec3> corners_;
  std::map<Index, int> lines_at_;                         // ends of lines, at their nodes
  std::vector<std::shared_ptr<const Surface>> surfaces_;  // #regions
  std::vector<Triangulation> regions_;                    // #regions
  std::vector<TriangleTree> region_trees_;                // #regions
  Triangulation triangles_;                               // of all regions
  std::vector<Index> region_of_triangle_;
  TriangleTree tree_;
};

/// The mesh edges along the feature lines of a reference surface, and the nodes at the ends of the
/// lines.
///
/// Distances are relative to the shortest edges at the ends of an edge, so that a row of thin
/// elements beside a line does not count as on it. An edge is on a line if its ends and its
/// midpoint are within 0.3 and it has the direction of the line. If these edges cover less than
/// half of a line, edges at which the mesh turns by the feature angle may be within 0.7.
///
/// An open line that is not completely covered is then searched for as a whole: a chain of
/// connected edges along it, within 0.5, or within 1 where the mesh turns by half of the feature
/// angle. Of all chains the one with the greatest worth is chosen: covered length, weighted by
/// nearness and by the angle of the mesh. Dynamic programming finds it exactly, since the arc
/// length grows along a chain. It replaces the edges that were found first if it is longer, has at
/// least two edges and covers half of the line.
class ReferenceLines {
 public:
  /// angle: of features, in degrees. x: of all nodes of the mesh.
  ReferenceLines(const SpacePoints& x, std::span<const SurfaceFace> faces,
                 const SurfaceEdges& edges, Index node_count, const ReferenceShape& shape,
                 double angle);

  /// The line of each edge (#edges); -1: none.
  const std::vector<Index>& lines() const { return lines_; }
  /// Length of the shortest edge at each node (#nodes).
  const std::vector<double>& shortest() const { return shortest_; }
  /// Nodes that move to corners of the reference surface, which faces of the mesh would cut off.
  /// For each corner it is the nearest node at which the edges along a line end. Its distance must
  /// be between half and one mean length of its edges.
  const std::map<Index, Vec3>& corners() const { return corners_; }
  /// Nodes at which the edges along a line end before the line fades out. There the reference
  /// surface turns by less than the feature angle. Nodes within 0.3 of the end of the line do not
  /// count.
  const std::set<Index>& fading() const { return fading_; }

 private:
  /// An edge in the direction of a line.
  struct Step {
    Index edge, from, to;
    double begin, end;  ///< arc lengths along the line
    double worth;
  };

  double length(Index edge) const;
  double mean_length(Index node) const;  // of the edges at it
  Index line_along(Index edge, double share) const;
  void find_edges();
  void find_chains();
  std::vector<Step> steps_along(Index line, std::span<const Index> edges) const;
  std::vector<Step> best_chain(std::span<const Step> steps) const;
  bool meets_other_line(Index node, Index line) const;
  bool share_face(Index edge, Index other) const;
  void find_corners();

  SpacePoints x_;
  const SurfaceEdges& edges_;
  const ReferenceShape& shape_;
  std::vector<double> turns_;                 // #edges: 1, 1/2, 0: the angle, half of it, less
  std::vector<double> shortest_;              // #nodes
  std::vector<std::vector<Index>> edges_at_;  // #nodes
  std::vector<Index> lines_;                  // #edges
  std::vector<double> found_;                 // #lines, length of the edges along each
  std::map<Index, Vec3> corners_;
  std::set<Index> fading_;
};

}  // namespace winslow
