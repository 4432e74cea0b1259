#pragma once

#include <optional>
#include <span>

#include "core/index.h"
#include "core/layers/layer_stack.h"

namespace winslow {

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
