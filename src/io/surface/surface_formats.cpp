#include <algorithm>
#include <cstdint>
#include <cstring>

#include "io/surface/surface.h"

namespace winslow::io::surface {

namespace {

bool begins_with_any(std::string_view line, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](auto word) { return starts_with_word(line, word); });
}

bool is_obj_keyword(std::string_view line) {
  return begins_with_any(line, {"v", "f", "vn", "vt", "mtllib", "usemtl"});
}

/// Its header may say anything, "solid" as well: the number of triangles fits the size.
bool is_binary_stl(std::string_view content) {
  constexpr std::size_t header = 84;
  std::uint32_t count = 0;
  if (content.size() < header) return false;
  std::memcpy(&count, content.data() + header - sizeof count, sizeof count);
  return count > 0 && content.size() == header + std::size_t{50} * count;
}

Evidence recognise_stl(const Content& content) {
  if (is_binary_stl(content.whole)) return {Evidence::Kind::size};
  return signature_if(starts_with_word(content.first_line, "solid"));
}

}  // namespace

const MeshFormat obj_format{
    .name = "obj",
    .title = "Wavefront",
    .versions = "",
    .encodings = "text",
    .markers = "lost",
    .regions = "lost",
    .quadrilaterals = "yes",
    .volumes = "boundary only, a group for each marker",
    .writes_surfaces = true,
    .writes_volumes = true,
    .recognise = [](const Content& content) { return keyword_on_line(content, is_obj_keyword); },
    .read = read_obj,
    .write = [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                const WriteOptions&) { return write_obj(out, mesh, details); }};

const MeshFormat off_format{
    .name = "off",
    .title = "Object File Format",
    .versions = "",
    .encodings = "text",
    .markers = "lost",
    .regions = "lost",
    .quadrilaterals = "yes",
    .volumes = "boundary only",
    .writes_surfaces = true,
    .writes_volumes = true,
    .recognise =
        [](const Content& content) {
          return signature_if(begins_with_any(
              content.first_line, {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}));
        },
    .read = read_off,
    .write = [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                const WriteOptions&) { return write_off(out, mesh, details); }};

const MeshFormat ply_format{
    .name = "ply",
    .title = "Stanford PLY",
    .versions = "",
    .encodings = "text, binary of either byte order",
    .markers = "lost",
    .regions = "lost",
    .quadrilaterals = "yes",
    .volumes = "boundary only",
    .writes_surfaces = true,
    .writes_volumes = true,
    .has_binary = true,
    .recognise = [](const Content& content) { return signature_if(content.first_line == "ply"); },
    .read = read_ply,
    .write =
        [](std::ostream& out, const Mesh& mesh, const FormatDetails* details,
           const WriteOptions& options) { return write_ply(out, mesh, details, options.binary); }};

const MeshFormat stl_format{.name = "stl",
                            .title = "STL",
                            .versions = "",
                            .encodings = "text, binary",
                            .markers = "lost",
                            .regions = "lost",
                            .quadrilaterals = "become triangles",
                            .volumes = "boundary only, a solid for each marker in text",
                            .writes_surfaces = true,
                            .writes_volumes = true,
                            .has_binary = true,
                            .recognise = recognise_stl,
                            .read = read_stl,
                            .write = [](std::ostream& out, const Mesh& mesh,
                                        const FormatDetails* details, const WriteOptions& options) {
                              return write_stl(out, mesh, details, options.binary);
                            }};

}  // namespace winslow::io::surface
