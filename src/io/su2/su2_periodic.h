#pragma once

#include "io/format/parsed_mesh.h"
#include "io/su2/su2_lines.h"

/// Periodic boundaries in mesh files of SU2 up to version 6, written by SU2_MSH: transformations
/// (NPERIODIC=) from receiving to sending points, and lists of these points (markers SEND_RECEIVE).
/// A sending and a receiving point have the same position in their lists. A pair of markers has a
/// list of the points of one marker and their images on the other. A second list holds interior
/// points and their images in halo elements beyond that.
namespace winslow::io::su2 {

class PeriodicSections {
 public:
  /// Reads the lines after NPERIODIC=, and stops before the first line that does not belong to it.
  void read_transformations(LineReader& lines, const Line& count);
  /// Reads a marker SEND_RECEIVE from its line MARKER_TAG= in the same way.
  void read_list(LineReader& lines);

  /// Finds pairs of markers of a mesh, from the lists of a transformation if the file has any; else
  /// the markers that the transformation maps onto each other. Throws InputError for points that
  /// the mesh does not have, and for lists of different lengths.
  std::vector<GivenPairs> pairs_of(const Source& source, const MeshData& data) const;

 private:
  struct Transformation {
    std::int64_t index;
    std::size_t offset;
    RigidImage image;
  };
  struct Point {
    std::int64_t node, index;  ///< index: of the transformation; 0: of another partition
    std::size_t offset;
  };
  struct List {
    std::size_t offset;
    bool sends;
    std::vector<Point> points;
  };

  struct SentPoints {
    std::vector<const Point*> sent, received;
  };
  std::map<std::int64_t, SentPoints> points_by_transformation(const Source& source,
                                                              Index nodes) const;
  /// markers: the nodes of each, ascending.
  std::vector<GivenPairs> by_place(const MeshData& data,
                                   const std::vector<std::vector<Index>>& markers) const;

  std::vector<Transformation> transformations_;
  std::vector<List> lists_;
};

/// "MARKER_PERIODIC= ( lower, upper, 0, 0, 0, 0, 0, 0, 0, 1, 0 )", the line of SU2's configuration
/// file for a pair of periodic sides.
std::string configuration_line(const PeriodicPairs& pairs);

}  // namespace winslow::io::su2
