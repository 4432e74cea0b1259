#include <cstring>

#include "io/surface/surface.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io::surface {
namespace {

constexpr std::size_t header_bytes = 80;
constexpr std::size_t facet_bytes = 50;

using Point = std::array<double, 3>;

/// Merges corners at the same place into one vertex.
class Merger {
 public:
  explicit Merger(Builder& builder) : builder_(builder) {}

  Index node(Point p, std::size_t offset) {
    for (double& value : p) value += 0.0;  // -0 is the same place as 0
    // NaN has no order. It becomes a separate vertex, which a later check rejects with its line.
    const bool ordered = p[0] == p[0] && p[1] == p[1] && p[2] == p[2];
    if (ordered) {
      const auto [found, added] = nodes_.emplace(p, builder_.vertices());
      if (!added) return found->second;
    }
    builder_.add_vertex(p[0], p[1], p[2], offset);
    return builder_.vertices() - 1;
  }

 private:
  Builder& builder_;
  std::map<Point, Index> nodes_;
};

void require(Scanner& scan, std::string_view keyword, Index facet) {
  const auto word = scan.next_word();
  if (word != keyword) {
    scan.fail(word, std::string(keyword) + " of facet " + std::to_string(facet + 1));
  }
}

ParsedMesh read_ascii(Source& source) {
  Scanner scan(source);
  Builder builder(source);
  Merger merger(builder);
  scan.line();
  for (Index facet = 0;; ++facet) {
    scan.skip_space();
    const std::size_t offset = scan.offset();
    const auto word = scan.word();
    if (word == "endsolid") break;
    if (word != "facet") scan.fail(word, "facet or endsolid");
    scan.line();
    require(scan, "outer", facet);
    scan.line();
    std::array<Index, 3> corners{};
    for (Index& corner : corners) {
      require(scan, "vertex", facet);
      const std::size_t place = scan.offset();
      Point p{};
      for (double& value : p) value = scan.number({"a coordinate of facet", facet});
      corner = merger.node(p, place);
      scan.end_line({"the end of the line in facet", facet});
    }
    require(scan, "endloop", facet);
    require(scan, "endfacet", facet);
    builder.add_face(corners, offset);
  }
  scan.line();
  const auto rest = scan.next_word();
  if (!rest.empty()) scan.fail(rest, "one solid");
  return builder.finish();
}

ParsedMesh read_binary(Source& source) {
  source.set_binary_from(0);
  const auto text = source.text();
  std::uint32_t count = 0;
  if (text.size() < header_bytes + sizeof count) {
    source.fail(text.size(), "the end of the file", "a header of 84 bytes");
  }
  std::memcpy(&count, text.data() + header_bytes, sizeof count);
  const std::size_t data = text.size() - header_bytes - sizeof count;
  if (data / facet_bytes != count || data % facet_bytes != 0) {
    source.fail(header_bytes, std::to_string(count) + " as the number of facets",
                std::to_string(data / facet_bytes) + " as the size of the file says");
  }
  Builder builder(source);
  Merger merger(builder);
  for (std::uint32_t f = 0; f < count; ++f) {
    const std::size_t offset = header_bytes + sizeof count + f * facet_bytes;
    std::array<Index, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<float, 3> xyz{};
      const std::size_t place = offset + (k + 1) * sizeof xyz;
      std::memcpy(xyz.data(), text.data() + place, sizeof xyz);
      corners[k] = merger.node({xyz[0], xyz[1], xyz[2]}, place);
    }
    builder.add_face(corners, offset);
  }
  return builder.finish(true);
}

/// Calls `facet(a, b, c)` for a triangle, and for both halves of a quadrilateral.
template <class Facet>
void for_each_facet(const FileCorners& n, Facet&& facet) {
  facet(n[0], n[1], n[2]);
  if (n.size() == 4) facet(n[0], n[2], n[3]);
}

std::uint32_t facet_count(const WrittenSurface& surface) {
  std::uint32_t n = 0;
  for (const FileCorners& face : surface.faces()) n += face.size() == 3 ? 1 : 2;
  return n;
}

/// Normal of a triangle of the surface, without negative zeros.
Vec3 facet_normal(const WrittenSurface& surface, Index a, Index b, Index c) {
  return surface.normal({{a, b, c}, 3}) + Vec3::Zero();
}

void write_solid(TextWriter& out, const WrittenSurface& surface,
                 const WrittenSurface::Group& group) {
  const std::string name = group.name.empty() ? "mesh" : as_word(group.name);
  out << "solid " << name << '\n';
  for (std::size_t f = group.first; f < group.first + group.count; ++f) {
    for_each_facet(surface.faces()[f], [&](Index a, Index b, Index c) {
      const Vec3 n = facet_normal(surface, a, b, c);
      out << "facet normal " << n.x() << ' ' << n.y() << ' ' << n.z() << "\nouter loop\n";
      for (const Index node : {a, b, c}) {
        const Vec3 p = surface.node(node);
        out << "vertex " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
      }
      out << "endloop\nendfacet\n";
    });
  }
  out << "endsolid " << name << '\n';
}

/// Returns false if a coordinate had to be rounded to single precision.
bool write_binary(TextWriter& out, const WrittenSurface& surface) {
  bool exact = true;
  std::array<char, header_bytes> header{};
  out.raw(header);
  out.raw(facet_count(surface));
  for (const FileCorners& face : surface.faces()) {
    for_each_facet(face, [&](Index a, Index b, Index c) {
      const Eigen::Vector3f n = facet_normal(surface, a, b, c).cast<float>();
      out.raw(std::array<float, 3>{n.x(), n.y(), n.z()});
      for (const Index node : {a, b, c}) {
        const Vec3 p = surface.node(node);
        for (const double value : {p.x(), p.y(), p.z()}) {
          const auto rounded = static_cast<float>(value);
          exact = exact && static_cast<double>(rounded) == value;
          out.raw(rounded);
        }
      }
      out.raw(std::uint16_t{0});
    });
  }
  return exact;
}

/// True if the number of triangles fits the size. The header is free text and may begin with
/// "solid".
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

/// Corners at exactly the same place become one node, in the order in which they first appear.
ParsedMesh read_stl(Source& source) {
  // Some programs start binary files with "solid" too, so the size decides.
  const auto text = source.text();
  std::uint32_t count = 0;
  if (text.size() >= header_bytes + sizeof count) {
    std::memcpy(&count, text.data() + header_bytes, sizeof count);
    if (text.size() == header_bytes + sizeof count + count * facet_bytes)
      return read_binary(source);
  }
  return text.starts_with("solid") ? read_ascii(source) : read_binary(source);
}

/// Quadrilaterals become two triangles each; binary STL holds single precision.
std::vector<std::string> write_stl(std::ostream& stream, const Mesh& mesh,
                                   const FormatDetails* source, const WriteOptions& options) {
  std::vector<std::string> warnings = lost_in_surface(mesh, !options.binary);
  const WrittenSurface surface(mesh, source);
  TextWriter out(stream);
  if (!options.binary) {
    for (const WrittenSurface::Group& group : surface.groups()) write_solid(out, surface, group);
  } else if (!write_binary(out, surface)) {
    warnings.emplace_back("binary STL holds single precision: the coordinates are rounded");
  }
  if (facet_count(surface) != surface.faces().size()) {
    warnings.emplace_back("STL holds triangles only: quadrilaterals are written as two of them");
  }
  return warnings;
}

}  // namespace

const MeshFormat stl_format{.name = "stl",
                            .title = "STL",
                            .encodings = "text, binary",
                            .markers = "lost",
                            .regions = "lost",
                            .quadrilaterals = "become triangles",
                            .volumes = "boundary only, a solid for each marker in text",
                            .keeps_markers = false,
                            .has_binary = true,
                            .recognise = recognise_stl,
                            .read = read_stl,
                            .write = write_stl};

}  // namespace winslow::io::surface
