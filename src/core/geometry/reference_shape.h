#pragma once

#include <array>
#include <map>
#include <optional>

#include "core/geometry/reference_surface.h"
#include "core/geometry/surface/triangle_tree.h"
#include "core/geometry/surface_shapes.h"

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

}  // namespace winslow
