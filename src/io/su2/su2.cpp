#include "io/su2/su2.h"

namespace winslow::io::su2 {
namespace {

/// Indexed by ElementType.
constexpr std::array<std::int64_t, 6> numbers{5, 9, 10, 14, 13, 12};

/// SU2's element types for faces of a mesh.
struct FaceElement {
  std::int64_t number;
  std::size_t corners;
  int dimension;
};
constexpr std::array<FaceElement, 3> face_elements{{{3, 2, 1}, {5, 3, 2}, {9, 4, 2}}};

std::optional<ElementType> any_element_of(std::int64_t number) {
  for (const ElementType type : fixed_element_types) {
    if (element_number(type) == number) return type;
  }
  return std::nullopt;
}

}  // namespace

std::int64_t element_number(ElementType type) { return numbers[static_cast<std::size_t>(type)]; }

std::optional<ElementType> element_of(std::int64_t number, int dimension) {
  const auto type = any_element_of(number);
  return type && dimension_of(*type) == dimension ? type : std::nullopt;
}

std::int64_t face_number(std::size_t corners) { return face_elements[corners - 2].number; }

std::size_t face_corners(std::int64_t number, int dimension) {
  for (const FaceElement& face : face_elements)
    if (face.number == number && face.dimension + 1 == dimension) return face.corners;
  return 0;
}

std::string element_list(int dimension) {
  constexpr std::array lists{"", "3 (line)", "5 (triangle) or 9 (quadrilateral)",
                             "10 (tetrahedron), 12 (hexahedron), 13 (prism) or 14 (pyramid)"};
  return lists[at(dimension)];
}

std::string type_hint(std::int64_t number, const Dimensions& of, bool of_marker) {
  // For elements with Lagrange nodes, SU2 adds 100 for each order above the first.
  if (number > 100 && number < 2000) return " (order " + std::to_string(number / 100 + 1) + ")";
  if (const auto type = any_element_of(number)) {
    if (dimension_of(*type) == of.cells - (of_marker ? 1 : 0)) return {};
    if (of.space == 2) return " (a 3D mesh)";
    if (of_marker) {
      return of.cells == 2 ? " (in a surface mesh, whose markers are lines)" : " (a 3D element)";
    }
    return of.cells == 2 ? " (a volume element in a surface mesh, as the first element is of one)"
                         : " (a surface element in a volume mesh, as the first element is of one)";
  }
  if (number >= 21 && number <= 37) return " (second order)";
  return {};
}

namespace {

bool is_keyword(std::string_view line) {
  for (const std::string_view key :
       {"NDIME", "NPOIN", "NELEM", "NMARK", "MARKER_TAG", "MARKERTAG", "NZONE", "IZONE"}) {
    if (line.starts_with(key) && line.find('=') != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace

const MeshFormat format{
    .name = "su2",
    .title = "SU2",
    .markers = "yes, by name",
    .regions = "no",
    .keeps_periodic = true,
    .recognise = [](const Content& content) { return keyword_on_line(content, is_keyword); },
    .read_zone = read_zone,
    .read_zones = read_zones,
    .write = write,
    .write_zones = write_zones};

}  // namespace winslow::io::su2
