#include "io/su2/su2.h"

namespace winslow::io::su2 {

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
    .versions = "",
    .encodings = "text",
    .markers = "yes, by name",
    .regions = "no",
    .quadrilaterals = "yes",
    .volumes = "yes",
    .writes_surfaces = true,
    .writes_volumes = true,
    .keeps_markers = true,
    .keeps_periodic = true,
    .recognise = [](const Content& content) { return keyword_on_line(content, is_keyword); },
    .read = [](Source& source) { return read_zone(source, 0); },
    .read_zone = read_zone,
    .write = [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                const WriteOptions&) { return write(out, mesh, details); },
    .write_zones = [](std::ostream& out, std::span<const MeshZone> zones,
                      const WriteOptions&) { return write_zones(out, zones); }};

}  // namespace winslow::io::su2
