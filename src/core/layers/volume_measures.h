#pragma once

#include "core/layers/layer_stack.h"

/// The heights of the layers of a volume mesh, normal to the wall:
///
///     const auto normals = winslow::column_normals(stack, x);
///     const auto heights = winslow::column_heights(stack.columns[c], normals[c], x);
///     std::printf("first %g, wanted %g\n", heights[0], stack.columns[c].heights[0]);
///
/// Let n be the normal of the wall at a column with the direction d and the slant s. The height of
/// layer k, between the nodes p_k and p_(k+1), is
///
///   n . (p_(k+1) - p_k) / (s n . d).
///
/// For a straight column along d this is the length of the edge over s, which is how the plane
/// defines heights. A node that moves along the wall changes no height; the tilt shows that.
namespace winslow {

/// The normal of the wall at each column, into the layers: the mean over the wall's faces at the
/// column, weighted by their angles there. The direction of the column where all of these faces
/// have no area, as inside a fan.
std::vector<Vec3> column_normals(const LayerStack& stack, const Coordinates& x);

/// Heights of the layers of a column as above (#heights). normal: of column_normals().
std::vector<double> column_heights(const LayerColumn& column, const Vec3& normal,
                                   const Coordinates& x);

/// measure_layers() of a volume mesh. x: #nodes by 3; where walls have moved since the layers were
/// inserted, see carried_by_walls(). The thickness of a column is the sum of its heights. The tilt
/// is the angle between its first edge and the normal; -1 inside a fan, along a boundary, and
/// without layers.
LayerMeasures measure_volume_layers(const LayerStack& stack, const Coordinates& x);

/// The stack after its walls have moved from `before` to `after` (#nodes by 3): directions of
/// columns turn with the walls at their wall nodes.
LayerStack carried_by_walls(LayerStack stack, const Coordinates& before, const Coordinates& after);

/// Multiplies the corrections of all layers by the wanted height over the present height, at least
/// by 1/2 and at most by 2.
void correct_volume_layers(LayerStack& stack, const Coordinates& x);

}  // namespace winslow
