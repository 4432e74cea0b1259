#pragma once

#include <vector>

#include "core/mesh/compressed_rows.h"
#include "core/mesh/mesh.h"

namespace winslow {

/// Nodes and elements of a volume mesh in an order, along the Z-order curve, in which what is near
/// in space is near in memory: for many sections of one mesh. Mesh files have them in any order,
/// and most of a section's time would go into waiting for memory. It serves for as long as the
/// connectivity stays, wherever nodes have gone.
struct SectionOrder {
  /// Throws UsageError unless it is a volume mesh.
  explicit SectionOrder(const Mesh& mesh);

  std::vector<Index> nodes;     ///< of the mesh, by their numbers here
  std::vector<Index> elements;  ///< likewise
  CompressedRows corners;       ///< of elements, both by their numbers here
};

}  // namespace winslow
