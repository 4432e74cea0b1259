#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/mesh/element_type.h"

namespace winslow::io::openfoam {

struct Cell {
  ElementType type;
  std::vector<Index> corners;
};

/// The element that a cell is whose faces these are, seen from outside counter-clockwise. Nothing
/// if it is no tetrahedron, pyramid, prism or hexahedron. Corner 0 is the first node of its first
/// triangle, of a pyramid of its quadrilateral, of a hexahedron of its first face.
std::optional<Cell> build_cell(std::span<const Face> faces);

}  // namespace winslow::io::openfoam
