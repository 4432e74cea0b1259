#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/mesh/element_type.h"

namespace winslow::io::su2 {

/// Of a zone: 2 and 2 of a plane mesh, 3 and 3 of a volume mesh, space 3 and cells 2 of a surface
/// mesh.
struct Dimensions {
  int space = 2;  ///< NDIME=
  int cells = 2;  ///< of the elements
};

/// The element that a number of SU2 (which are VTK's) stands for: triangles and quadrilaterals of
/// dimension 2, tetrahedra (10), hexahedra (12), prisms (13) and pyramids (14) of dimension 3.
std::optional<ElementType> element_of(std::int64_t number, int dimension);
std::int64_t element_number(ElementType type);
/// Number of the element that a face of a mesh is: 3 (line), 5 (triangle) or 9 (quadrilateral).
std::int64_t face_number(std::size_t corners);
/// Number of corners of such a face of elements of that dimension; 0: it cannot be one.
std::size_t face_corners(std::int64_t number, int dimension);

/// "5 (triangle) or 9 (quadrilateral)": what elements of that dimension are.
std::string element_list(int dimension);
/// " (second order)" and the like: why an element type is none of the elements, or of the elements
/// of markers, of a mesh of those dimensions; may be empty.
std::string type_hint(std::int64_t number, const Dimensions& of, bool of_marker);

}  // namespace winslow::io::su2
