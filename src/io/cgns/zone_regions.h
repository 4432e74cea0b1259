#pragma once

#include <string>
#include <vector>

#include "io/cgns/sections.h"

namespace winslow::io::cgns {

/// Makes regions of the parts of an unstructured zone that name cells (ZoneSubRegion_t with
/// GridLocation CellCenter). An element has one region, the first that names it.
void read_regions(const NodeView& zone, const ElementNumbers& numbers, MeshData& mesh,
                  std::vector<std::string>& warnings);

}  // namespace winslow::io::cgns
