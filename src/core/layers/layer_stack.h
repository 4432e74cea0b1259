#pragma once

#include "core/mesh/mesh.h"
#include "core/types.h"

/// Columns of layers, as a state has them once they are inserted:
///
///     for (const winslow::LayerColumn& column : state.layers->columns)
///       std::printf("node %d: %zu layers\n", column.wall_node, column.count());
namespace winslow {

/// Why a column of layers is thinner than asked, or has fewer layers.
enum class LayerLimit {
  none,
  clearance,  ///< another wall, or another part of the same one, is near
  crossing,   ///< neighbouring columns lean towards one another: a concave corner
  neighbour,  ///< thickness may not change faster along the wall
  end,        ///< the wall ends here
  room        ///< the elements outside could be pushed no further
};
std::string_view limit_name(LayerLimit limit);  ///< "clearance", ...

/// Why the layers that a mesh was read with are followed no further from the wall.
enum class LayerEnd {
  none,        ///< they were inserted, not found
  elements,    ///< no quadrilateral or pair of triangles continues the strip
  boundary,    ///< the next node lies on the boundary
  meeting,     ///< the next node belongs to another column
  isotropic,   ///< cells are less than twice as long as high
  growth,      ///< heights no longer grow, or jump
  clearance,   ///< another boundary, or another part of the wall, is near
  neighbours,  ///< the layers beside them end
  count        ///< as many as were to be looked for
};
std::string_view end_name(LayerEnd end);  ///< "elements", ...

/// The nodes of layers above one place of a wall. At a sharp convex corner several columns stand on
/// one wall node (a fan).
struct LayerColumn {
  Index wall_node = -1;
  int wall = 0;                 ///< place of its wall in the list of walls
  Vec2 direction{0, 0};         ///< unit vector from the wall
  double slant = 1;             ///< length along the column for each unit of height
  bool along_boundary = false;  ///< at the end of a wall: the column lies on the next boundary
  double first = 0;             ///< height of the first layer that was asked for
  double asked = 0;             ///< thickness that was asked for, in units of the mesh
  double room = 0;              ///< thickness that there is room for
  LayerLimit limit = LayerLimit::none;
  bool prescribed = false;      ///< the thickness is an override: no rule takes of it
  std::vector<double> heights;  ///< wanted height of each layer; empty: the layers end here
  /// Heights and limit before walls came so near that there is no room for them; empty: as above.
  std::vector<double> granted;
  LayerLimit granted_limit = LayerLimit::none;
  /// What each wanted height is multiplied by in the VCVs so that it is met; empty: 1.
  std::vector<double> corrections;
  /// Of a column that was found: angle of each of its edges to `direction`, counter-clockwise, in
  /// radians (#heights); empty: the column is straight.
  std::vector<double> bends;
  LayerEnd end = LayerEnd::none;
  std::vector<Index> nodes;  ///< #heights + 1, the wall node first; filled by insertion

  std::size_t count() const { return heights.size(); }
  double thickness() const { return std::accumulate(heights.begin(), heights.end(), 0.0); }
  Index rim() const { return nodes.back(); }
};

/// Two neighbouring columns; along the wall, elements on the left, `left` comes first.
struct ColumnPair {
  std::size_t left = 0, right = 0;
};

/// Layers of elements along walls.
struct LayerStack {
  std::vector<LayerColumn> columns;
  std::vector<ColumnPair> pairs;
  /// #elements: layer of each, 0 at the wall; -1 outside the layers. Filled by insertion.
  std::vector<int> layer_of_element;
  bool held = false;  ///< the VCVs of the layers' nodes ask for the wanted heights
};

/// Distance that is wanted between nodes k and k + 1 of a column.
inline double wanted_length(const LayerColumn& column, std::size_t k) {
  return column.heights[k] * column.slant;
}

/// How a column stands on its wall.
struct ColumnStand {
  Vec2 direction{0, 0};  ///< unit vector
  double slant = 1;      ///< length along the column for each unit of height
};

/// How `count` columns stand on one wall node whose edges, on the way along the wall, are
/// `arriving` and `leaving` (elements on the left): one halves the angle; several, a fan, stand
/// from the normal of the one edge to that of the other.
std::vector<ColumnStand> stand_on(const Vec2& arriving, const Vec2& leaving, std::size_t count);

/// How all columns stand on the walls in x (#nodes by 2). Those at the end of a wall, on another
/// boundary: along its edge.
std::vector<ColumnStand> column_stands(const LayerStack& stack, const Coordinates& x);

/// Puts the nodes of all columns at `scale` times their wanted distances from the wall, in the
/// columns' directions as planned.
void lay_out(const LayerStack& stack, double scale, Coordinates& x);

/// x with all columns of the wanted heights, straight, or on their course if they were found, as
/// they stand on the walls in x.
Coordinates straight_columns(const LayerStack& stack, const Coordinates& x);

/// What one place of a wall is to have instead of what the rules would choose for it.
struct ColumnOverride {
  Index node = -1;             ///< of a wall
  std::optional<int> columns;  ///< that stand on the node: 1 is no fan
  /// Of all layers there, in units of the mesh; 0: the layers end there. Gaps, corners and
  /// neighbours do not limit it (it limits its neighbours); where the wall ends it can only be
  /// less than the rules say, and a mesh that would be invalid still takes its part.
  std::optional<double> thickness;

  bool operator==(const ColumnOverride&) const = default;
};

/// Throws UsageError: an override that says nothing, a number out of range, a node given twice.
void validate(std::span<const ColumnOverride> overrides);

/// Throws UsageError naming a node that has no column in the stack: its override would be lost.
void require_columns(std::span<const ColumnOverride> overrides, const LayerStack& stack);

}  // namespace winslow
