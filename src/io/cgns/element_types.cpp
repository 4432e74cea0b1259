#include "io/cgns/element_types.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace winslow::io::cgns {
namespace {

/// In the order of ElementType_t.
constexpr std::array<std::string_view, 57> names{"ElementTypeNull",
                                                 "ElementTypeUserDefined",
                                                 "NODE",
                                                 "BAR_2",
                                                 "BAR_3",
                                                 "TRI_3",
                                                 "TRI_6",
                                                 "QUAD_4",
                                                 "QUAD_8",
                                                 "QUAD_9",
                                                 "TETRA_4",
                                                 "TETRA_10",
                                                 "PYRA_5",
                                                 "PYRA_14",
                                                 "PENTA_6",
                                                 "PENTA_15",
                                                 "PENTA_18",
                                                 "HEXA_8",
                                                 "HEXA_20",
                                                 "HEXA_27",
                                                 "MIXED",
                                                 "PYRA_13",
                                                 "NGON_n",
                                                 "NFACE_n",
                                                 "BAR_4",
                                                 "TRI_9",
                                                 "TRI_10",
                                                 "QUAD_12",
                                                 "QUAD_16",
                                                 "TETRA_16",
                                                 "TETRA_20",
                                                 "PYRA_21",
                                                 "PYRA_29",
                                                 "PYRA_30",
                                                 "PENTA_24",
                                                 "PENTA_38",
                                                 "PENTA_40",
                                                 "HEXA_32",
                                                 "HEXA_56",
                                                 "HEXA_64",
                                                 "BAR_5",
                                                 "TRI_12",
                                                 "TRI_15",
                                                 "QUAD_P4_16",
                                                 "QUAD_25",
                                                 "TETRA_22",
                                                 "TETRA_34",
                                                 "TETRA_35",
                                                 "PYRA_P4_29",
                                                 "PYRA_50",
                                                 "PYRA_55",
                                                 "PENTA_33",
                                                 "PENTA_66",
                                                 "PENTA_75",
                                                 "HEXA_44",
                                                 "HEXA_98",
                                                 "HEXA_125"};

/// Corners are numbered alike (core/mesh/element_type.h).
constexpr std::array<std::pair<std::int64_t, ElementType>, 6> ours{{{5, ElementType::triangle},
                                                                    {7, ElementType::quadrilateral},
                                                                    {10, ElementType::tetrahedron},
                                                                    {12, ElementType::pyramid},
                                                                    {14, ElementType::prism},
                                                                    {17, ElementType::hexahedron}}};

}  // namespace

std::string element_name(std::int64_t type) {
  if (type < 0 || type >= static_cast<std::int64_t>(names.size()))
    return "type " + std::to_string(type);
  return std::string(names[static_cast<std::size_t>(type)]);
}

std::optional<ElementType> element_of(std::int64_t type) {
  for (const auto& [number, element] : ours)
    if (number == type) return element;
  return std::nullopt;
}

std::int64_t element_number(ElementType type) {
  const auto* found = std::find_if(ours.begin(), ours.end(),
                                   [&](const auto& entry) { return entry.second == type; });
  return found->first;
}

std::string element_hint(std::int64_t type, int cell_dimension) {
  const auto element = element_of(type);
  const bool solid = (element && dimension_of(*element) == 3) || type == nface_n;
  if (solid && cell_dimension == 2) return " (a 3D mesh)";
  if (type == nface_n) return " (polyhedra)";
  const bool known = type > node_element && type < static_cast<std::int64_t>(names.size());
  return known && !element && type != bar_2 && type != mixed && type != ngon_n
             ? " (second or higher order)"
             : "";
}

}  // namespace winslow::io::cgns
