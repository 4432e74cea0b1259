#include "io/gmsh/gmsh.h"

namespace winslow::io::gmsh {

const ShapeInfo& info_of(Shape shape) {
  static constexpr std::array<ShapeInfo, 8> shapes{
      {{15, 0, 1}, {1, 1, 2}, {2, 2, 3}, {3, 2, 4}, {4, 3, 4}, {5, 3, 8}, {6, 3, 6}, {7, 3, 5}}};
  return shapes[static_cast<std::size_t>(shape)];
}

Shape element_shape(ElementType type) {
  static constexpr std::array<Shape, 6> shapes{Shape::triangle,    Shape::quadrilateral,
                                               Shape::tetrahedron, Shape::pyramid,
                                               Shape::prism,       Shape::hexahedron};
  return shapes[static_cast<std::size_t>(type)];
}

Shape face_shape(const Face& face) {
  return face.size() == 2 ? Shape::line : face.size() == 3 ? Shape::triangle : Shape::quadrilateral;
}

ElementType element_of(Shape shape) {
  for (const ElementType type : all_element_types) {
    if (element_shape(type) == shape) return type;
  }
  return ElementType::triangle;
}

const MeshFormat format{
    .name = "msh",
    .title = "Gmsh",
    .versions = "2.2 and 4.1",
    .encodings = "text, binary",
    .markers = "yes, name and tag",
    .regions = "yes",
    .quadrilaterals = "yes",
    .volumes = "yes",
    .writes_surfaces = true,
    .writes_volumes = true,
    .keeps_markers = true,
    .keeps_periodic = true,
    .has_binary = true,
    .recognise =
        [](const Content& content) {
          const std::string_view first = content.first_line;
          return signature_if(first == "$MeshFormat" || first == "$NOD" || first == "$Comments");
        },
    .read = read,
    .write =
        [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
           const io::WriteOptions& options) {
          const auto* own = dynamic_cast<const Details*>(details);
          const bool newest = own == nullptr || own->version_4;
          const bool version_4 =
              options.gmsh_version.empty() ? newest : options.gmsh_version == "4.1";
          return write(out, mesh, details, {version_4, options.binary});
        }};

}  // namespace winslow::io::gmsh
