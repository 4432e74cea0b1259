#include "core/layers/column_override.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"

namespace winslow {

void validate(std::span<const ColumnOverride> overrides) {
  constexpr int most_columns = 20;
  std::vector<Index> nodes;
  for (const ColumnOverride& own : overrides) {
    const auto require = [&](bool good, const char* what) {
      if (!good) throw UsageError("node " + std::to_string(own.node) + ": " + what);
    };
    require(own.columns || own.thickness, "neither a number of columns nor a thickness is given");
    require(!own.columns || (*own.columns >= 1 && *own.columns <= most_columns),
            "the number of columns must be 1 to 20");
    require(!own.thickness || (std::isfinite(*own.thickness) && *own.thickness >= 0),
            "the thickness of a column must be finite and not negative");
    nodes.push_back(own.node);
  }
  std::ranges::sort(nodes);
  const auto twice = std::ranges::adjacent_find(nodes);
  if (twice != nodes.end()) {
    throw UsageError("node " + std::to_string(*twice) + " is given columns of its own twice");
  }
}

void require_columns(std::span<const ColumnOverride> overrides, const LayerStack& stack) {
  for (const ColumnOverride& own : overrides) {
    const bool found =
        std::ranges::find(stack.columns, own.node, &LayerColumn::wall_node) != stack.columns.end();
    if (found) continue;
    throw UsageError("node " + std::to_string(own.node) +
                     " is given columns of its own, but is on none of the walls");
  }
}

}  // namespace winslow
