#include "io/gmsh/gmsh.h"

namespace winslow::io::gmsh {

const MeshFormat format{
    .name = "msh",
    .title = "Gmsh",
    .versions = "2.2 and 4.1",
    .encodings = "text, binary",
    .markers = "yes, name and tag",
    .regions = "yes",
    .quadrilaterals = "yes",
    .keeps_markers = true,
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
