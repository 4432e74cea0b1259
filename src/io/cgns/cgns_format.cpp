#include "io/cgns/cgns.h"

namespace winslow::io::cgns {
const MeshFormat format{
    .name = "cgns",
    .title = "CGNS",
    .versions = "",
    .encodings = "HDF5, ADF",
    .markers = "yes, by name",
    .regions = "yes, not in structured zones",
    .quadrilaterals = "yes",
    .volumes = "yes, unstructured zones",
    .writes_volumes = true,
    .keeps_markers = true,
    .keeps_periodic = true,
    .missing = no_library,
    .recognise =
        [](const Content& content) {
          return signature_if(container_of(content.whole).has_value());
        },
    .read = [](Source& source) { return read_zone(source, 0); },
    .read_zone = read_zone,
    .write = [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                const WriteOptions& options) { return write(out, mesh, details, options); },
    .write_zones = write_zones};

}  // namespace winslow::io::cgns
