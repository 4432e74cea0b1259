#pragma once

#include "core/quality/metric.h"
#include "core/quality/wall_measures.h"

/// The heights of the cells at walls:
///
///     const auto heights = winslow::element_values(mesh, winslow::WallField::first_height);
namespace winslow {

/// What elements at walls are like, and beside their neighbours, as a number of each element (see
/// wall_measures.h):
/// - first_height: of an element with an edge on a wall, the mean of the first heights at the ends
///   of that edge, in units of the mesh;
/// - first_height_ratio: of such an element, the first height over what it was before, at that end
///   of its edge where this is further from 1, as a factor;
/// - first_edge_tilt: of such an element, the larger of the tilts at the ends of its edge, degrees;
/// - growth: of an element in a column of quadrilaterals over a wall, the larger of its ratios to
///   the next cells of the column;
/// - size_ratio: of any element, the largest of its size ratios.
/// Of an element with several edges on walls, or in several columns, the largest value, of the
/// ratio that which is furthest from 1. Other elements have NaN.
enum class WallField { first_height, first_height_ratio, first_edge_tilt, growth, size_ratio };

const std::vector<WallField>& all_wall_fields();
const FieldInfo& wall_field_info(WallField field);

/// Value of each element (#elements). before: the same nodes as they were before (#nodes by 2),
/// which only first_height_ratio needs; null, or of another number of nodes: that has no values.
std::vector<double> element_values(const Mesh& mesh, WallField field,
                                   const Coordinates* before = nullptr);

}  // namespace winslow
