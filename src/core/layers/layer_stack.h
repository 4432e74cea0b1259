#pragma once

#include "core/mesh/mesh.h"
#include "core/quality/quality.h"
#include "core/types.h"

/// Columns of layers, as a state has them once they are inserted:
///
///     for (const winslow::LayerColumn& column : state.layers->columns)
///       std::printf("node %d: %zu layers\n", column.wall_node, column.count());
namespace winslow {

/// The reason why a column of layers is thinner than asked or has fewer layers.
enum class LayerLimit {
  none,
  clearance,  ///< another wall or another part of the wall is near
  crossing,   ///< neighbouring columns lean towards one another: a concave corner
  neighbour,  ///< the change of thickness along the wall is limited
  end,        ///< the wall ends here
  room        ///< the elements outside could not be moved further
};
std::string_view limit_name(LayerLimit limit);  ///< "clearance", ...

/// The reason why the layers that were found in a mesh end.
enum class LayerEnd {
  none,        ///< the layers were inserted
  elements,    ///< no quadrilateral or pair of triangles continues the strip
  boundary,    ///< the next node lies on the boundary
  meeting,     ///< the next node belongs to another column
  isotropic,   ///< cells are less than twice as long as high
  growth,      ///< heights no longer grow, or jump
  clearance,   ///< another boundary, or another part of the wall, is near
  neighbours,  ///< the layers beside end
  count        ///< the wanted number of layers was found
};
std::string_view end_name(LayerEnd end);  ///< "elements", ...

/// The nodes of layers above a wall node. A fan at a sharp convex corner has several columns on one
/// wall node.
struct LayerColumn {
  Index wall_node = -1;
  int wall = 0;                 ///< index of its wall in the list of walls
  Vec3 direction{0, 0, 0};      ///< unit vector from the wall; z is 0 in the plane
  double slant = 1;             ///< length along the column per unit of height
  bool along_boundary = false;  ///< at the end of a wall: the column lies on the next boundary
  double first = 0;             ///< height asked for the first layer
  double asked = 0;             ///< thickness asked for, in units of the mesh
  double room = 0;              ///< largest possible thickness
  LayerLimit limit = LayerLimit::none;
  bool prescribed = false;      ///< the thickness is an override, which no rule reduces
  std::vector<double> heights;  ///< wanted height of each layer; empty: the layers end here
  /// Heights and limit before moving walls reduced the room; empty: those above.
  std::vector<double> granted;
  LayerLimit granted_limit = LayerLimit::none;
  /// Factors of the heights in the VCVs, with which the mesh gets the wanted heights; empty: 1.
  std::vector<double> corrections;
  /// For a column that was found in the mesh: angle from `direction` to each edge,
  /// counter-clockwise, radians (#heights); empty: the column is straight.
  std::vector<double> bends;
  LayerEnd end = LayerEnd::none;
  std::vector<Index> nodes;  ///< #heights + 1, the wall node first; filled by insertion

  std::size_t count() const { return heights.size(); }
  double thickness() const { return std::accumulate(heights.begin(), heights.end(), 0.0); }
  Index rim() const { return nodes.back(); }
  Vec2 plane_direction() const { return direction.head<2>(); }
};

/// Two neighbouring columns; `left` is the first along the wall with the elements on the left.
struct ColumnPair {
  std::size_t left = 0, right = 0;
};

/// A face of a wall of a volume mesh by the columns at its nodes, counter-clockwise seen from the
/// layers.
struct ColumnFace {
  std::array<std::size_t, 4> columns{};
  int count = 0;  ///< 3 or 4

  std::span<const std::size_t> corners() const {
    return std::span(columns).first(static_cast<std::size_t>(count));
  }
};

/// Layers of elements along walls.
struct LayerStack {
  std::vector<LayerColumn> columns;
  std::vector<ColumnPair> pairs;  ///< of a plane mesh
  std::vector<ColumnFace> faces;  ///< of a volume mesh
  /// #elements: layer of each, 0 at the wall; -1 outside the layers. Filled by insertion.
  std::vector<int> layer_of_element;
  bool held = false;  ///< the VCVs of the nodes in layers have the wanted heights
};

/// Calls settle(pair) for all pairs, forward and backward, until it returns false for all of them
/// (true: it changed a column); at most 100 times.
template <class Settle>
void sweep_pairs(std::span<const ColumnPair> pairs, const Settle& settle) {
  constexpr int most_sweeps = 100;
  bool changed = true;
  for (int sweep = 0; changed && sweep < most_sweeps; ++sweep) {
    changed = false;
    for (std::size_t k = 0; k < pairs.size(); ++k) changed |= settle(pairs[k]);
    for (std::size_t k = pairs.size(); k-- > 0;) changed |= settle(pairs[k]);
  }
}

/// Wanted distance between nodes k and k + 1 of a column.
inline double wanted_length(const LayerColumn& column, std::size_t k) {
  return column.heights[k] * column.slant;
}

/// Direction and slant of a column on its wall.
struct ColumnStand {
  Vec2 direction{0, 0};  ///< unit vector
  double slant = 1;      ///< length along the column per unit of height
};

/// Gives a column of a plane mesh its direction and its slant.
inline void set_stand(LayerColumn& column, const ColumnStand& stand) {
  column.direction = {stand.direction.x(), stand.direction.y(), 0};
  column.slant = stand.slant;
}

/// Directions of `count` columns on one wall node. arriving, leaving: its wall edges along the
/// wall, with the elements on the left. A single column bisects the angle; the columns of a fan are
/// spread from the normal of one edge to that of the other.
std::vector<ColumnStand> stand_on(const Vec2& arriving, const Vec2& leaving, std::size_t count);

/// Directions of all columns on the walls in x (#nodes by 2). A column at the end of a wall, on the
/// next boundary, has the direction of the edge there.
std::vector<ColumnStand> column_stands(const LayerStack& stack, const Coordinates& x);

/// Moves the nodes of all columns to `scale` times their wanted distances from the wall, along the
/// planned directions. x: #nodes by 2, or by 3 in space.
void lay_out(const LayerStack& stack, double scale, Coordinates& x);

/// x with all nodes of columns at their wanted distances from the walls in x. Columns are straight,
/// but those that were found in the mesh keep their bends.
Coordinates straight_columns(const LayerStack& stack, const Coordinates& x);

/// Columns and thickness of one wall node in place of those that the rules choose.
struct ColumnOverride {
  Index node = -1;             ///< of a wall
  std::optional<int> columns;  ///< number of columns on the node; 1: no fan
  /// Thickness of all layers there, in units of the mesh; 0: no layers. Gaps, corners and
  /// neighbours do not limit it, and it limits its neighbours. At the end of a wall it cannot be
  /// more than the rules allow. It is still reduced where the mesh would be invalid.
  std::optional<double> thickness;

  bool operator==(const ColumnOverride&) const = default;
};

/// Throws UsageError for an empty override, a number out of range, or a repeated node.
void validate(std::span<const ColumnOverride> overrides);

/// Throws UsageError naming a node of an override that has no column in the stack.
void require_columns(std::span<const ColumnOverride> overrides, const LayerStack& stack);

/// Measures of the layers of a state:
///
///     const auto measures = winslow::measure_layers(*state.layers, state.mesh.coordinates);
///     std::printf("heights off by %.2f %% at most\n", 100 * measures.spacing_error.max);

/// The realised heights of one column of layers.
struct ColumnMeasure {
  double first_height = 0;  ///< normal to the wall, in units of the mesh
  double thickness = 0;     ///< of all layers, normal to the wall
  /// Largest |height / wanted - 1| of its layers, and that of the first.
  double spacing_error = 0, first_error = 0;
  /// Degrees between the first edge of the column and the normal of the wall, the mean over its
  /// wall edges; -1 for a column inside a fan, along a boundary or without layers.
  double tilt = -1;
};

/// The realised heights of all layers. Statistics are over the columns that have layers.
struct LayerMeasures {
  std::vector<ColumnMeasure> columns;  ///< #columns of the stack
  Statistics first_height, thickness, spacing_error, first_error;
  Statistics orthogonality;   ///< tilt, degrees
  std::size_t cut_short = 0;  ///< columns for which cut_short() is true
};

/// x: #nodes by 2.
LayerMeasures measure_layers(const LayerStack& stack, const Coordinates& x);

/// Whether a column is thinner than asked by more than 0.1 %, or has no layers.
bool cut_short(const LayerColumn& column);

}  // namespace winslow
