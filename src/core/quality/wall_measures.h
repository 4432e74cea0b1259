#pragma once

#include "core/mesh/mesh.h"

namespace winslow {

/// The boundary of a body: a closed loop of the mesh's boundary with the body inside. The loop
/// around the mesh (around each of its connected parts) is none: what of it is a wall, an inlet or
/// a symmetry line, a mesh does not say.
struct Wall {
  std::vector<Index> nodes;          ///< along the loop, the elements on its left; closed
  std::vector<std::string> markers;  ///< that have faces in it, in the order of the mesh's markers
};

/// The walls of a plane mesh, in the order of its boundary loops. Throws UsageError for another.
std::vector<Wall> find_walls(const Mesh& mesh);

/// How a list of numbers is spread.
struct Quantiles {
  std::size_t count = 0;  ///< 0: there are none, and the rest says nothing
  double min = 0, low = 0, median = 0, high = 0, max = 0;  ///< low: 5 %, high: 95 %
};

/// Of the finite ones among the values. The q-quantile of n sorted values lies at place q (n - 1),
/// linearly between its two neighbours (R. J. Hyndman, Y. Fan, Am. Stat. 50, 1996, type 7).
Quantiles quantiles_of(std::vector<double> values);

/// What the user of a flow solver judges the cells at walls by. All of it is for plane meshes of
/// triangles and quadrilaterals; units are those of the mesh unless said otherwise.

/// First heights at the nodes of a wall (#nodes of it; NaN where there is none).
///
/// Each edge of the wall has one element. At either end of the edge, the corner of that element
/// that faces the end is the one to which an edge off the wall leads from there (of a
/// quadrilateral), or the apex (of a triangle). Its height is its distance from the wall: the least
/// distance to the edge itself and to the wall's next edge on either side, as line segments. The
/// first height of a node is the mean of the heights that the two edges meeting there give for it.
///
/// On an O-grid both heights are of the same corner, the next node along the grid line off the
/// wall. Triangles that touch the wall with a corner only do not count, so that it does not matter
/// how many edges leave a node. A corner that lies on the three edges itself (a quadrilateral in a
/// concave corner) is no height: the other far corner stands in, or the edge says nothing.
std::vector<double> first_heights(const Mesh& mesh, const Wall& wall);

/// By how many degrees the first edge off each node of a wall deviates from the wall's normal there
/// (#nodes; NaN where no edge leads off the wall, or the normal is not defined). The normal is the
/// mean of the unit normals of the two wall edges; the first edge is that which deviates least.
std::vector<double> first_edge_tilts(const Mesh& mesh, const Wall& wall);

/// A ratio of two neighbouring elements, the larger over the smaller: at least 1.
struct NeighbourRatio {
  std::array<Index, 2> elements;
  double value;
};

/// Growth ratios along the columns of quadrilaterals that stand on a wall's edges, one for each
/// pair of consecutive cells, in no special order: the larger of their heights over the smaller, so
/// at least 1. The height of a cell is the distance between the midpoints of its edge towards the
/// wall and the one opposite. A column ends at a triangle and at the boundary: a wall that has
/// triangles has no ratios.
std::vector<NeighbourRatio> column_growth(const Mesh& mesh, const Wall& wall);

/// Size ratios of all pairs of elements that share an edge: the square root of the larger area over
/// the smaller, at least 1, in the order of the edges. Pairs with an area that is not positive are
/// left out.
std::vector<NeighbourRatio> size_ratios(const Mesh& mesh);

std::vector<double> values_of(std::span<const NeighbourRatio> ratios);

/// One wall.
struct WallMeasures {
  Wall wall;
  std::vector<double> first_height, tilt;  ///< see first_heights() and first_edge_tilts()
  Quantiles growth;                        ///< of column_growth()
};

/// All walls of a mesh.
struct WallReport {
  std::vector<WallMeasures> walls;
  Quantiles first_height, tilt, growth;  ///< of all of them together
  Quantiles size_ratio;                  ///< of the whole mesh

  Index node_count() const;
};

WallReport measure_walls(const Mesh& mesh);

}  // namespace winslow
