#pragma once

#include "core/layers/layer_stack.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/topology.h"

namespace winslow {

/// The elements between two neighbouring columns, row by row from the wall.
struct Strip {
  struct Row {
    std::array<Index, 2> elements{-1, -1};
    double height = 0;  ///< mean length of the edges of its two columns, in units of the mesh
  };
  std::size_t left = 0, right = 0;  ///< columns
  std::size_t chain = 0;            ///< which run of wall edges it stands on
  bool fan = false;                 ///< it begins with a triangle whose tip lies on the wall
  std::vector<Row> rows;
  bool open = true;  ///< a row may follow
  LayerEnd end = LayerEnd::none;
  double next_height = 0;  ///< of the row that may follow
};

/// Takes away what is above so many rows, for the reason named.
void shorten(Strip& strip, std::size_t rows, LayerEnd why);

/// Why a row of this height and width (along the wall) does not belong to the layers of its strip:
/// it is less than twice as wide as high, or much higher or lower than the row below. None if it
/// does. A sector of a fan may be as narrow as it likes.
LayerEnd fault_of_row(const Strip& strip, double height, double width);

/// Calls close(s) for the open strips of each chain where the next rows are mostly lower than those
/// below them: on the way to another wall.
void close_where_heights_shrink(const std::vector<Strip>& strips,
                                const std::function<void(std::size_t)>& close);

/// Takes away the outermost rows of a chain up to the last one that is mostly higher, by one part
/// in a hundred or more, than the row below; all rows if none is.
void end_where_growth_ends(std::vector<Strip>& strips, std::size_t chain);

/// A strip has at most two rows more than those beside it, a sector of a fan no more than they.
void level_neighbours(std::vector<Strip>& strips, std::size_t columns);

/// One row of a strip of elements between two columns: a quadrilateral, or the two triangles that a
/// diagonal makes of one.
struct StripStep {
  Index left = -1, right = -1;            ///< nodes that the two columns go on to
  std::array<Index, 2> elements{-1, -1};  ///< second: -1 if the first is a quadrilateral
  OpenMesh::HalfedgeHandle top;           ///< from `left` to `right`, what is above on its left
};

/// The rows that may lie above an edge, which leads from the left column to the right one with what
/// is above on its left: one for a quadrilateral; for a triangle up to two, with the triangle
/// beyond either of its other sides; none at the boundary. Geometry has to tell which of two it is.
std::vector<StripStep> steps_above(const Topology& topology, OpenMesh::HalfedgeHandle edge);

}  // namespace winslow
