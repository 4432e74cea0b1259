#pragma once

#include "core/layers/layer_stack.h"
#include "core/quality/quality.h"

/// How well the layers of a state came out:
///
///     const auto measures = winslow::measure_layers(*state.layers, state.mesh.coordinates);
///     std::printf("heights off by %.2f %% at most\n", 100 * measures.spacing_error.max);
namespace winslow {

/// One column of layers as it came out.
struct ColumnMeasure {
  double first_height = 0;  ///< normal to the wall, in units of the mesh
  double thickness = 0;     ///< of all layers, normal to the wall
  /// Largest |height / wanted - 1| of its layers, and that of the first.
  double spacing_error = 0, first_error = 0;
  /// Degrees between the first edge of the column and the normal of the wall (the mean of the edges
  /// on which it stands); -1 where there is none: inside a fan, on a boundary, no layers.
  double tilt = -1;
};

/// Layers as they came out, over the columns that have any.
struct LayerMeasures {
  std::vector<ColumnMeasure> columns;  ///< #columns of the stack
  Statistics first_height, thickness, spacing_error, first_error;
  Statistics orthogonality;   ///< tilt, degrees
  std::size_t cut_short = 0;  ///< columns thinner than asked, or without layers
};

/// Throws nothing; x: #nodes by 2.
LayerMeasures measure_layers(const LayerStack& stack, const Coordinates& x);

/// A column that is thinner than asked by more than one part in a thousand, or ends.
bool cut_short(const LayerColumn& column);

}  // namespace winslow
