#include <array>

#include "io/medit/medit.h"

namespace winslow::io::medit {

std::span<const Kind> kinds() {
  static constexpr std::array<Kind, 7> all{{{"Edges", std::nullopt, 2, 1},
                                            {"Triangles", ElementType::triangle, 3, 2},
                                            {"Quadrilaterals", ElementType::quadrilateral, 4, 2},
                                            {"Tetrahedra", ElementType::tetrahedron, 4, 3},
                                            {"Pyramids", ElementType::pyramid, 5, 3},
                                            {"Prisms", ElementType::prism, 6, 3},
                                            {"Hexahedra", ElementType::hexahedron, 8, 3}}};
  return all;
}

const MeshFormat format{
    .name = "mesh",
    .title = "Medit",
    .versions = "",
    .encodings = "text",
    .markers = "yes, tag, and name in a comment",
    .regions = "yes, tag, and name in a comment",
    .quadrilaterals = "yes",
    .volumes = "yes",
    .writes_surfaces = true,
    .writes_volumes = true,
    .keeps_markers = true,
    .recognise =
        [](const Content& content) {
          return keyword_on_line(content, [](std::string_view line) {
            return starts_with_word(line, "MeshVersionFormatted");
          });
        },
    .read = read,
    .write = [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                const WriteOptions&) { return write(out, mesh, details); }};

}  // namespace winslow::io::medit
