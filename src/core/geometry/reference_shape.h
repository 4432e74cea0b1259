#pragma once

#include <set>

#include "core/geometry/sliding_boundary.h"
#include "core/geometry/surface/triangulation.h"
#include "core/geometry/surface_features.h"
#include "core/mesh/surface_faces.h"

namespace winslow {

/// A reference surface cut at its features: what can be slid on, and what lies where.
class ReferenceShape {
 public:
  /// angle: of features, in degrees. Throws UsageError for a surface without faces.
  ReferenceShape(const ReferenceSurface& given, double angle);

  const std::string& source() const { return source_; }

  Index line_count() const { return static_cast<Index>(features_.lines.size()); }
  /// Goes on straight where the line fades out.
  const std::shared_ptr<const SpaceCurve>& curve(Index line) const {
    return curves_.curves[at(line)];
  }
  double length(Index line) const { return lengths_[at(line)]; }

  /// A place on a feature line.
  struct LinePlace {
    Index line;
    double distance;
    Vec3 tangent;  ///< of length 1; of the chord there
  };
  /// The nearest feature line no farther away than `reach`.
  std::optional<LinePlace> nearest_line(const Vec3& point, double reach) const;
  /// The lines of which boxes around their segments come within `reach`, ascending: all that are
  /// so near, and some more.
  std::vector<Index> lines_about(const Vec3& point, double reach) const;

  /// The place of a line that is nearest to a point.
  struct LineFoot {
    Vec3 point;
    double distance;
    double arc;  ///< from the line's beginning
  };
  LineFoot foot_on_line(Index line, const Vec3& point) const;
  bool closed(Index line) const { return features_.lines[at(line)].closed; }

  /// Where feature lines meet or turn, and tips of cones; not where a line fades out.
  const std::vector<Vec3>& corners() const { return corners_; }
  /// Where a line that does not close begins or ends.
  struct LineEnd {
    Vec3 point;
    bool fades_out;  ///< no other line comes there: it is no corner
  };
  std::array<LineEnd, 2> ends(Index line) const;

  struct SurfacePlace {
    Index region;
    double distance;
  };
  SurfacePlace nearest_region(const Vec3& point) const;
  /// Distance to the triangles of one region.
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

/// Which edges of a mesh run along the feature lines of a reference surface, and where the lines
/// end.
///
/// Near is measured by the shortest edges at the ends of an edge, so that rows of thin elements
/// beside a line are told from it. An edge belongs to a line if its ends and its middle lie within
/// .3 of that, and it points along the line. Where a line is not found so along half of its length,
/// the edges at which the mesh turns by the feature angle may be .7 away.
///
/// A line that is not found all along, and does not close, is looked for as a whole then: as the
/// chain of edges that goes on along it, within .5 of it, or within 1 where the mesh turns by half
/// of the feature angle; of all such chains the one that covers most of it, its parts the more so
/// the nearer they are to it and the more the mesh turns there (exact, by dynamic programming:
/// along a chain the length of arc grows). It takes the place of what was found before if it is
/// longer, has two edges at least, and covers half of the line.
class ReferenceLines {
 public:
  /// angle: of features, in degrees. x: of all nodes of the mesh.
  ReferenceLines(const SpacePoints& x, std::span<const SurfaceFace> faces,
                 const SurfaceEdges& edges, Index node_count, const ReferenceShape& shape,
                 double angle);

  /// #edges; -1: along none.
  const std::vector<Index>& lines() const { return lines_; }
  /// Length of the shortest edge at each node (#nodes).
  const std::vector<double>& shortest() const { return shortest_; }
  /// The corners of the reference surface that faces of the mesh would cut off, and the nodes for
  /// them: of the nodes in which the edges along a line that comes from a corner end, the nearest
  /// one, if between half and one mean length of the edges at it away.
  const std::map<Index, Vec3>& corners() const { return corners_; }
  /// Nodes in which the edges along a line end where it fades out: the reference surface turns by
  /// less than the feature angle beyond. Not those that are at its end (.3).
  const std::set<Index>& fading() const { return fading_; }

 private:
  /// An edge as a line runs.
  struct Step {
    Index edge, from, to;
    double begin, end;  ///< lengths of arc along the line
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
