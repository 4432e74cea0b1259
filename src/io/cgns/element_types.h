#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/mesh/element_type.h"

namespace winslow::io::cgns {

/// Numbers of the element types that readers and writers treat apart (ElementType_t of the SIDS).
enum : std::int64_t { node_element = 2, bar_2 = 3, mixed = 20, ngon_n = 22, nface_n = 23 };

/// "QUAD_4"; "type 99" for a number that means nothing.
std::string element_name(std::int64_t type);
/// The element of ours that a type of CGNS is, if it is one: TRI_3, ..., HEXA_8.
std::optional<ElementType> element_of(std::int64_t type);
std::int64_t element_number(ElementType type);
/// " (second or higher order)" and the like: why a type is none of ours in a mesh of cells of that
/// dimension; may be empty.
std::string element_hint(std::int64_t type, int cell_dimension);

}  // namespace winslow::io::cgns
