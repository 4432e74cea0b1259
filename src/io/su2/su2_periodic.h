#pragma once

#include "io/format/parsed_mesh.h"
#include "io/su2/su2_lines.h"

/// Periodic boundaries as SU2 kept them in its mesh files up to version 6, written by SU2_MSH:
/// transformations (NPERIODIC=) from receiving points to sending ones, and lists of these points
/// (markers SEND_RECEIVE), in which a point that is received stands where its sender does. One list
/// of a pair of markers holds the points of the one marker and their images on the other, the next
/// one points of the interior and their images in halo elements beyond that.
namespace winslow::io::su2 {

class PeriodicSections {
 public:
  /// Reads what follows the line NPERIODIC=, and returns at the first line after it.
  void read_transformations(LineReader& lines, const Line& count);
  /// Reads a marker SEND_RECEIVE from its line MARKER_TAG= on, likewise.
  void read_list(LineReader& lines);

  /// Pairs of the markers of a mesh. By the lists, if the file has any for a transformation; else
  /// those markers that a transformation takes to one another. Throws InputError for points that
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

/// "MARKER_PERIODIC= ( lower, upper, 0, 0, 0, 0, 0, 0, 0, 1, 0 )", as the configuration file of SU2
/// names sides that a transformation takes to one another.
std::string configuration_line(const PeriodicPairs& pairs);

}  // namespace winslow::io::su2
