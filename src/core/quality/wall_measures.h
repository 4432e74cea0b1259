#pragma once

#include "core/mesh/mesh.h"
#include "core/quality/metric.h"

namespace winslow {

/// The boundary of a body: a closed loop of the boundary of the mesh with the body inside. The loop
/// around the mesh, or around each of its connected parts, is no Wall, since the mesh does not say
/// which parts of it are walls, inlets or symmetry lines.
struct Wall {
  std::vector<Index> nodes;          ///< along the loop, with the elements on the left
  std::vector<std::string> markers;  ///< markers with faces in it, in the order of the mesh
};

/// The walls of a plane mesh, in the order of its boundary loops. Throws UsageError for other
/// meshes.
std::vector<Wall> find_walls(const Mesh& mesh);

/// The distribution of a list of numbers.
struct Quantiles {
  std::size_t count = 0;  ///< 0: no numbers; the other members are then 0
  double min = 0, low = 0, median = 0, high = 0, max = 0;  ///< low: 5 %, high: 95 %
};

/// The quantiles of the finite values. The q-quantile of n sorted values lies at place q (n - 1),
/// linearly between its two neighbours (R. J. Hyndman, Y. Fan, Am. Stat. 50, 1996, type 7).
Quantiles quantiles_of(std::vector<double> values);

/// Measures of the cells at walls, which matter to flow solvers. They are for plane meshes of
/// triangles and quadrilaterals. Lengths are in units of the mesh.

/// First heights at the nodes of a wall (#nodes of it; NaN for a node without a height).
///
/// Each edge of the wall has one element. The height of the edge at one of its ends is that of a
/// corner of this element: of a quadrilateral the other end of the edge that leads from there off
/// the wall, of a triangle the apex. The height of a corner is its distance from the wall: the
/// smallest distance from the edge and from the wall edges before and after it, as line segments.
/// The first height of a node is the mean of the heights of its two wall edges there.
///
/// On an O-grid both heights are of the same corner, the next node along the grid line off the
/// wall. Triangles with only a corner on the wall do not count, so that the number of edges at a
/// node does not matter. If the corner lies on one of the three edges (a quadrilateral in a concave
/// corner), the other corner of the quadrilateral off the edge is taken; if that lies on them, too,
/// the edge has no height.
std::vector<double> first_heights(const Mesh& mesh, const Wall& wall);

/// Mean lengths of the two wall edges at the nodes of a wall (#nodes of it), in units of the mesh.
std::vector<double> wall_spacings(const Mesh& mesh, const Wall& wall);

/// Angles in degrees between the first edge off each node of a wall and the wall's normal there
/// (#nodes; NaN if no edge leads off the wall, or the normal is not defined). The normal is the
/// mean of the unit normals of the two wall edges; the first edge is the one with the least angle.
std::vector<double> first_edge_tilts(const Mesh& mesh, const Wall& wall);

/// A ratio of two neighbouring elements, the larger over the smaller: at least 1.
struct NeighbourRatio {
  std::array<Index, 2> elements;
  double value;
};

/// Growth ratios along the columns of quadrilaterals on the edges of a wall: for each pair of
/// consecutive cells the larger of their heights over the smaller, at least 1, in no special order.
/// The height of a cell is the distance between the midpoints of its edge towards the wall and of
/// the opposite edge. A column ends at a triangle and at the boundary.
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
  std::vector<double> spacing;             ///< see wall_spacings()
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

/// The heights of the cells at walls:
///
///     const auto heights = winslow::element_values(mesh, winslow::WallField::first_height);

/// Fields for the cells at walls and for the sizes of neighbours, one number per element:
/// - first_height: of an element with an edge on a wall, the mean of the first heights at the ends
///   of that edge, in units of the mesh;
/// - first_height_ratio: of such an element, the first height over the earlier one, at the end of
///   its edge where this ratio is further from 1, as a factor;
/// - first_edge_tilt: of such an element, the larger of the tilts at the ends of its edge, degrees;
/// - growth: of an element in a column of quadrilaterals over a wall, the larger of its ratios to
///   the next cells of the column;
/// - size_ratio: of any element, the largest of its size ratios.
/// An element with several edges on walls, or in several columns, has the largest value, for the
/// ratio the value furthest from 1. Other elements have NaN.
enum class WallField { first_height, first_height_ratio, first_edge_tilt, growth, size_ratio };

const std::vector<WallField>& all_wall_fields();
const FieldInfo& wall_field_info(WallField field);

/// Value of each element (#elements). before: the earlier coordinates of the nodes (#nodes by 2),
/// only for first_height_ratio, which has no values if it is null or has another number of nodes.
std::vector<double> element_values(const Mesh& mesh, WallField field,
                                   const Coordinates* before = nullptr);

}  // namespace winslow
