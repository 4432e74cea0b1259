#include "io/cgns/cgns.h"

namespace winslow::io::cgns {
namespace {

/// The signature of HDF5 may follow a block of the user's own of 512, 1024, 2048, ... bytes.
bool is_hdf5(std::string_view bytes) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  constexpr std::size_t first = 512, last = std::size_t{1} << 20;
  if (bytes.starts_with(signature)) return true;
  for (std::size_t at = first; at <= last && at < bytes.size(); at *= 2)
    if (bytes.substr(at).starts_with(signature)) return true;
  return false;
}

}  // namespace

const MeshFormat format{
    .name = "cgns",
    .title = "CGNS",
    .versions = "2D",
    .encodings = "HDF5, ADF (written as HDF5, or as ADF where the source was)",
    .markers = "yes, by name",
    .regions = "no",
    .quadrilaterals = "yes",
    .keeps_markers = true,
    .missing = no_library,
    .recognise =
        [](const Content& content) {
          return signature_if(is_hdf5(content.whole) ||
                              content.whole.starts_with("@(#)ADF Database Version"));
        },
    .read = [](Source& source) { return read_zone(source, 0); },
    .read_zone = read_zone,
    .write = [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                const WriteOptions&) { return write(out, mesh, details); },
    .write_zones = write_zones};

}  // namespace winslow::io::cgns
