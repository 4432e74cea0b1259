#pragma once

#include "core/mesh/mesh.h"
#include "core/mesh/surface_faces.h"
#include "core/quality/metric.h"

namespace winslow {

/// The boundary of a body.
///
/// In the plane it is a closed loop of the boundary of the mesh with the body inside. The loop
/// around the mesh, or around each of its connected parts, is no Wall, since the mesh does not say
/// which parts of it are walls, inlets or symmetry lines.
///
/// In space it is the boundary faces of bodies that are connected by nodes: all faces but those
/// that enclose bodies (enclosing_faces()). So a wing that stands on a plane of symmetry is a Wall,
/// and the plane is none. A mesh whose boundary encloses no body, as that of a pipe, has no Wall.
struct Wall {
  std::vector<Index> nodes;  ///< in the plane along the loop, with the elements on the left; in
                             ///< space ascending
  std::vector<std::string> markers;     ///< markers with faces in it, in the order of the mesh
  std::vector<SurfaceFace> faces = {};  ///< of a volume mesh, in the order of boundary_faces()
};

/// The walls of a plane mesh, in the order of its boundary loops; of a volume mesh, in the order of
/// their first faces. Throws UsageError for a surface mesh.
std::vector<Wall> find_walls(const Mesh& mesh);

/// The distribution of a list of numbers.
struct Quantiles {
  std::size_t count = 0;  ///< 0: no numbers; the other members are then 0
  double min = 0, low = 0, median = 0, high = 0, max = 0;  ///< low: 5 %, high: 95 %
};

/// The quantiles of the finite values. The q-quantile of n sorted values lies at place q (n - 1),
/// linearly between its two neighbours (R. J. Hyndman, Y. Fan, Am. Stat. 50, 1996, type 7).
Quantiles quantiles_of(std::vector<double> values);

/// Measures of the cells at walls, which matter to flow solvers. They are for plane meshes and for
/// volume meshes of any elements. Lengths are in units of the mesh. A plane mesh and the same mesh
/// extruded have the same heights, tilts and growth ratios.

/// First heights at the nodes of a wall (#nodes of it; NaN for a node without a height).
///
/// In the plane, each edge of the wall has one element. The height of the edge at one of its ends
/// is that of a corner of this element: of a quadrilateral the other end of the edge that leads
/// from there off the wall, of a triangle the apex. The height of a corner is its distance from the
/// wall: the smallest distance from the edge and from the wall edges before and after it, as line
/// segments. The first height of a node is the mean of the heights of its two wall edges there.
///
/// On an O-grid both heights are of the same corner, the next node along the grid line off the
/// wall. Triangles with only a corner on the wall do not count, so that the number of edges at a
/// node does not matter. If the corner lies on one of the three edges (a quadrilateral in a concave
/// corner), the other corner of the quadrilateral off the edge is taken; if that lies on them, too,
/// the edge has no height.
///
/// In space, each face of the wall has one element. The height of the face at one of its nodes is
/// that of the node to which an edge of the element leads from there off the face: of a prism or a
/// hexahedron the next node up the layers, of a tetrahedron the apex. If there are several such
/// edges, as at the apex of a pyramid that lies on its side, it is the mean of their heights. The
/// height of a node is its distance from the wall: the smallest distance from the face and from the
/// wall faces that share a node with it. A face of more than three nodes counts as the triangles of
/// its edges with the mean of its nodes. The first height of a node is the mean of the heights of
/// its faces there, weighted by the angles of the faces.
///
/// So elements with only an edge or a node on the wall do not count, and how a wall is cut into
/// triangles does not matter. Edges that lead to nodes of these wall faces do not count. If none is
/// left (a hexahedron in a concave edge, a node in the middle of an edge of a polyhedron), the
/// nearest node is taken to which an edge leads off the face from another of its nodes; if there
/// is none, the face has no height at this node.
std::vector<double> first_heights(const Mesh& mesh, const Wall& wall);

/// Mean lengths of the wall edges at the nodes of a wall (#nodes of it), in units of the mesh: of
/// two edges in the plane, of all edges of wall faces in space.
std::vector<double> wall_spacings(const Mesh& mesh, const Wall& wall);

/// Angles in degrees between the first edge off each node of a wall and the wall's normal there
/// (#nodes; NaN if no edge leads off the wall, or the normal is not defined). The normal is the
/// mean of the unit normals of the two wall edges, in space of the wall faces, weighted by their
/// angles there; the first edge is the one with the least angle.
std::vector<double> first_edge_tilts(const Mesh& mesh, const Wall& wall);

/// A ratio of two neighbouring elements, the larger over the smaller: at least 1.
struct NeighbourRatio {
  std::array<Index, 2> elements;
  double value;
};

/// Growth ratios along the columns of cells on the edges or faces of a wall: for each pair of
/// consecutive cells the larger of their heights over the smaller, at least 1, in no special order.
///
/// In the plane the cells are quadrilaterals. The height of a cell is the distance between the
/// midpoints of its edge towards the wall and of the opposite edge. A column ends at a triangle and
/// at the boundary.
///
/// In space the cells have two opposite faces with as many nodes, joined by quadrilaterals: prisms
/// on their triangles, hexahedra, and polyhedra that are prisms over polygons. The height of a cell
/// is the distance between the means of the nodes of these two faces. A column ends at any other
/// cell and at the boundary.
std::vector<NeighbourRatio> column_growth(const Mesh& mesh, const Wall& wall);

/// Size ratios of all pairs of elements that share an edge, in space a face: the square root of the
/// larger area over the smaller, in space the cube root of the larger volume over the smaller. They
/// are at least 1, in the order of the edges or faces. Pairs with an area or a volume that is not
/// positive are left out. threads: for volume meshes, 0 for all cores; the result does not depend
/// on it.
std::vector<NeighbourRatio> size_ratios(const Mesh& mesh, int threads = 0);

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
/// - growth: of an element in a column over a wall, the larger of its ratios to the next cells of
///   the column;
/// - size_ratio: of any element, the largest of its size ratios.
/// In space it is the nodes of its face on the wall instead of the ends of an edge. An element with
/// several edges or faces on walls, or in several columns, has the largest value, for the ratio the
/// value furthest from 1. Other elements have NaN.
enum class WallField { first_height, first_height_ratio, first_edge_tilt, growth, size_ratio };

const std::vector<WallField>& all_wall_fields();
const FieldInfo& wall_field_info(WallField field);

/// Value of each element (#elements). before: the earlier coordinates of the nodes (#nodes by the
/// dimension of the mesh), only for first_height_ratio, which has no values if it is null or of
/// another number of nodes.
std::vector<double> element_values(const Mesh& mesh, WallField field,
                                   const Coordinates* before = nullptr);

/// Measures the walls of a mesh in several ways, and finds and measures each thing once:
///
///     winslow::WallSurvey survey(mesh);
///     const winslow::WallReport report = survey.report();
///     const auto growth = survey.element_values(winslow::WallField::growth);
class WallSurvey {
 public:
  /// mesh: kept by reference. threads: for volume meshes, 0 for all cores; no result depends on it.
  /// Throws UsageError for a surface mesh.
  explicit WallSurvey(const Mesh& mesh, int threads = 0);

  /// As measure_walls().
  WallReport report();
  /// As the function of this name.
  std::vector<double> element_values(WallField field, const Coordinates* before = nullptr);

 private:
  using Lists = std::vector<std::vector<double>>;
  const Lists& heights();
  const Lists& tilts();
  /// The growth ratios of each wall.
  const std::vector<std::vector<NeighbourRatio>>& growths();
  const std::vector<NeighbourRatio>& sizes();
  Lists height_ratios(const Coordinates& before);

  const Mesh& mesh_;
  int threads_;
  std::vector<Wall> walls_;
  // Empty until they are needed.
  std::optional<Lists> heights_, tilts_;
  std::optional<std::vector<std::vector<NeighbourRatio>>> growths_;
  std::optional<std::vector<NeighbourRatio>> sizes_;
};

}  // namespace winslow
