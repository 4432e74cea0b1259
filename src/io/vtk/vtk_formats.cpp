#include "io/vtk/grid.h"

namespace winslow::io::vtk {

const MeshFormat legacy_format{
    .name = "vtk",
    .title = "VTK",
    .versions = "legacy, versions 1 to 5 (written as 3.0)",
    .encodings = "text, binary",
    .markers = "yes, see below",
    .regions = "yes",
    .quadrilaterals = "yes",
    .volumes = "yes",
    .writes_surfaces = true,
    .writes_volumes = true,
    .keeps_markers = true,
    .has_binary = true,
    .recognise =
        [](const Content& content) {
          return signature_if(content.first_line.starts_with("# vtk DataFile"));
        },
    .read = read_legacy,
    .write =
        [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
           const WriteOptions& options) {
          return write_legacy(out, mesh, details, options.binary);
        }};

const MeshFormat vtu_format{
    .name = "vtu",
    .title = "VTK XML",
    .versions = "",
    .encodings =
        "text, inline base64, appended raw and base64, zlib (written as text or appended raw)",
    .markers = "yes, see below",
    .regions = "yes",
    .quadrilaterals = "yes",
    .volumes = "yes",
    .writes_surfaces = true,
    .writes_volumes = true,
    .keeps_markers = true,
    .has_binary = true,
    .recognise =
        [](const Content& content) {
          return signature_if(content.start.starts_with("<") &&
                              content.start.substr(0, 2000).find("<VTKFile") !=
                                  std::string_view::npos);
        },
    .read = read_vtu,
    .write =
        [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
           const WriteOptions& options) { return write_vtu(out, mesh, details, options.binary); }};

}  // namespace winslow::io::vtk
