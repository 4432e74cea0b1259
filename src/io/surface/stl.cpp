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

/// Corners of a facet and their places in the file.
struct Facet {
  std::array<Point, 3> corners{};
  std::array<std::size_t, 3> places{};
};

/// Collects facets into a surface. Facets with two corners in one place are left out and counted.
class FacetCollector {
 public:
  explicit FacetCollector(const Source& source) : source_(source), builder_(source) {}

  Builder& builder() { return builder_; }

  void add(const Facet& facet, std::size_t offset) {
    const auto& [a, b, c] = facet.corners;
    if (a == b || b == c || c == a) {
      if (left_out_++ == 0) first_ = offset;
      return;
    }
    std::array<Index, 3> nodes{};
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = merger_.node(facet.corners[k], facet.places[k]);
    builder_.add_face(nodes, offset);
  }

  ParsedMesh finish(bool binary) {
    if (left_out_ > 0) {
      builder_.mesh().warnings.push_back(
          std::to_string(left_out_) + (left_out_ == 1 ? " facet has" : " facets have") +
          " two corners in one place, the first at " + source_.place(first_) + ": left out");
    }
    return builder_.finish(binary);
  }

 private:
  const Source& source_;
  Builder builder_;
  Merger merger_{builder_};
  std::size_t left_out_ = 0, first_ = 0;
};

/// Reads text. Keywords may be in capitals, as some programs write them.
class TextReader {
 public:
  explicit TextReader(const Source& source) : scan_(source), facets_(source) {}

  ParsedMesh read() {
    for (scan_.skip_space(); !scan_.at_end(); scan_.skip_space()) read_solid();
    if (solids_ > 1) add_regions();
    return facets_.finish(false);
  }

 private:
  void require(std::string_view keyword) {
    const auto word = scan_.next_word();
    if (lower_case(word) != keyword)
      scan_.fail(word, std::string(keyword) + " of facet " + std::to_string(facet_ + 1));
  }

  void read_solid() {
    const auto word = scan_.word();
    if (lower_case(word) != "solid") scan_.fail(word, "solid, or the end of the file");
    const std::string name(trimmed(scan_.line()));
    auto& groups = facets_.builder().mesh().data.element_region;
    const Index solid = solid_of(name);
    ++solids_;
    for (;; ++facet_) {
      scan_.skip_space();
      const std::size_t offset = scan_.offset();
      const auto keyword = scan_.word();
      const std::string lower = lower_case(keyword);
      if (lower == "endsolid") break;
      if (lower != "facet") scan_.fail(keyword, "facet or endsolid");
      scan_.line();
      facets_.add(read_facet(), offset);
      groups.resize(facets_.builder().mesh().data.types.size(), solid);
    }
    scan_.line();
  }

  Facet read_facet() {
    require("outer");
    scan_.line();
    Facet facet;
    for (std::size_t k = 0; k < 3; ++k) {
      require("vertex");
      facet.places[k] = scan_.offset();
      for (double& value : facet.corners[k])
        value = scan_.number({"a coordinate of facet", facet_});
      scan_.end_line({"the end of the line in facet", facet_});
    }
    require("endloop");
    require("endfacet");
    return facet;
  }

  /// Solids of one name are one region.
  Index solid_of(const std::string& name) {
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end()) return static_cast<Index>(found - names_.begin());
    names_.push_back(name);
    return static_cast<Index>(names_.size()) - 1;
  }

  void add_regions() {
    auto& regions = facets_.builder().mesh().data.regions;
    for (std::size_t s = 0; s < names_.size(); ++s) {
      const int tag = static_cast<int>(s) + 1;
      regions.push_back({names_[s].empty() ? "solid_" + std::to_string(tag) : names_[s], tag});
    }
  }

  Scanner scan_;
  FacetCollector facets_;
  std::vector<std::string> names_;
  std::size_t solids_ = 0;
  Index facet_ = 0;
};

ParsedMesh read_text(const Source& source) {
  ParsedMesh mesh = TextReader(source).read();
  if (mesh.data.regions.empty()) mesh.data.element_region.clear();
  return mesh;
}

std::uint32_t facet_count(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header_bytes + sizeof count)
    std::memcpy(&count, bytes.data() + header_bytes, sizeof count);
  return count;
}

/// Size of a binary file with as many facets as its header says.
std::size_t size_by_header(std::string_view bytes) {
  return header_bytes + sizeof(std::uint32_t) + std::size_t{facet_count(bytes)} * facet_bytes;
}

ParsedMesh read_binary(Source& source) {
  source.set_binary_from(0);
  const auto text = source.text();
  const std::uint32_t count = facet_count(text);
  constexpr std::size_t begin = header_bytes + sizeof count;
  if (text.size() < begin) source.fail(text.size(), "the end of the file", "a header of 84 bytes");
  if (text.size() < size_by_header(text)) {
    source.fail(header_bytes, std::to_string(count) + " as the number of facets",
                "at most " + std::to_string((text.size() - begin) / facet_bytes) +
                    " as the size of the file says");
  }
  FacetCollector facets(source);
  bool colours = text.substr(0, header_bytes).find("COLOR=") != std::string_view::npos;
  for (std::uint32_t f = 0; f < count; ++f) {
    const std::size_t offset = begin + f * facet_bytes;
    Facet facet;
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<float, 3> xyz{};
      facet.places[k] = offset + (k + 1) * sizeof xyz;
      std::memcpy(xyz.data(), text.data() + facet.places[k], sizeof xyz);
      std::ranges::copy(xyz, facet.corners[k].begin());
    }
    facets.add(facet, offset);
    // Two bytes behind each facet, which many programs use for its colour.
    const std::size_t last = offset + facet_bytes - 2;
    colours = colours || text[last] != 0 || text[last + 1] != 0;
  }
  if (colours) facets.builder().drops("colours");
  if (const std::size_t more = text.size() - size_by_header(text); more > 0) {
    facets.builder().mesh().warnings.push_back(std::to_string(more) +
                                               (more == 1 ? " byte" : " bytes") + " behind the " +
                                               std::to_string(count) + " facets are not kept");
  }
  return facets.finish(true);
}

/// Calls `facet(a, b, c)` for a triangle, for both halves of a quadrilateral, and for the triangles
/// of a polygon.
template <class Facet>
void for_each_facet(const WrittenSurface& surface, const FileCorners& n, Facet&& facet) {
  if (n.size() > 4) {
    const Vec3 normal = surface.normal(n);
    const Vec3 u = normal.isZero() ? Vec3(Vec3::UnitX()) : Vec3(normal.unitOrthogonal());
    const Vec3 v = normal.isZero() ? Vec3(Vec3::UnitY()) : Vec3(normal.cross(u));
    std::vector<Vec2> places;
    for (const Index node : n)
      places.emplace_back(u.dot(surface.node(node)), v.dot(surface.node(node)));
    for (const auto& [a, b, c] : cut_polygon(places)) facet(n[at(a)], n[at(b)], n[at(c)]);
    return;
  }
  facet(n[0], n[1], n[2]);
  if (n.size() == 4) facet(n[0], n[2], n[3]);
}

std::uint32_t written_facets(const WrittenSurface& surface) {
  std::uint32_t n = 0;
  for (const FileCorners& face : surface.faces()) n += static_cast<std::uint32_t>(face.size() - 2);
  return n;
}

/// Normal of a triangle of the surface, without negative zeros.
Vec3 facet_normal(const WrittenSurface& surface, Index a, Index b, Index c) {
  return surface.normal(FileCorners(std::array{a, b, c})) + Vec3::Zero();
}

/// A named set of faces of the surface.
struct Solid {
  std::string name;
  std::vector<std::size_t> faces;
};

/// The solids of a text file: a group of a volume mesh or a region each; else one for all.
std::vector<Solid> solids_of(const Mesh& mesh, const WrittenSurface& surface,
                             std::vector<std::string>& warnings) {
  std::vector<Solid> solids;
  const auto of = mesh.topology->element_regions();
  if (of.empty() || mesh.topology->cell_dimension() == 3) {
    for (const WrittenSurface::Group& group : surface.groups()) {
      solids.push_back({group.name.empty() ? "mesh" : group.name, {}});
      for (std::size_t f = group.first; f < group.first + group.count; ++f)
        solids.back().faces.push_back(f);
    }
    return solids;
  }
  for (const Region& region : mesh.topology->regions()) solids.push_back({region.name, {}});
  solids.push_back({"mesh", {}});  // elements without a region
  for (std::size_t e = 0; e < of.size(); ++e)
    solids[of[e] < 0 ? solids.size() - 1 : at(of[e])].faces.push_back(e);
  std::erase_if(solids, [](const Solid& solid) { return solid.faces.empty(); });
  std::size_t next = 0;
  bool kept = true;
  for (const Solid& solid : solids)
    for (const std::size_t face : solid.faces) kept = kept && face == next++;
  if (!kept) warnings.emplace_back("STL holds facets by solid: their order has changed");
  return solids;
}

void write_solid(TextWriter& out, const WrittenSurface& surface, const Solid& solid) {
  const std::string name = within_line(solid.name);
  out << "solid " << name << '\n';
  for (const std::size_t f : solid.faces) {
    for_each_facet(surface, surface.faces()[f], [&](Index a, Index b, Index c) {
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
  out.raw(written_facets(surface));
  for (const FileCorners& face : surface.faces()) {
    for_each_facet(surface, face, [&](Index a, Index b, Index c) {
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
  return facet_count(content) > 0 && content.size() == size_by_header(content);
}

/// True if the first line begins with "solid", in capitals or not, and if a text follows.
bool is_text_stl(const Content& content) {
  constexpr std::size_t near = 2000;  // the name of a solid may be long
  if (!starts_with_word(lower_case(content.first_line), "solid")) return false;
  const auto start = content.start.substr(0, near);
  if (start.find('\0') != std::string_view::npos) return false;  // a header of 80 bytes
  const auto behind = lower_case(start.substr(std::min(start.find('\n'), start.size())));
  return behind.find("facet") != std::string::npos ||
         behind.find("endsolid") != std::string::npos || behind.size() < 2;
}

Evidence recognise_stl(const Content& content) {
  if (is_binary_stl(content.whole)) return {Evidence::Kind::size};
  return signature_if(is_text_stl(content));
}

/// Corners at exactly the same place become one node, in the order in which they first appear.
ParsedMesh read_stl(Source& source) {
  // Some programs start binary files with "solid" too, so the size decides.
  const bool text = !is_binary_stl(source.text()) && is_text_stl(Content(source.text()));
  return text ? read_text(source) : read_binary(source);
}

/// Quadrilaterals become two triangles each; binary STL holds single precision.
std::vector<std::string> write_stl(std::ostream& stream, const Mesh& mesh,
                                   const FormatDetails* source, const WriteOptions& options) {
  std::vector<std::string> warnings = lost_in_surface(mesh, !options.binary, !options.binary);
  const WrittenSurface surface(mesh, source);
  TextWriter out(stream);
  if (!options.binary) {
    for (const Solid& solid : solids_of(mesh, surface, warnings)) write_solid(out, surface, solid);
  } else if (!write_binary(out, surface)) {
    warnings.emplace_back("binary STL holds single precision: the coordinates are rounded");
  }
  if (written_facets(surface) != surface.faces().size()) {
    warnings.emplace_back("STL holds triangles only: quadrilaterals are written as two of them");
  }
  return warnings;
}

}  // namespace

const MeshFormat stl_format{.name = "stl",
                            .title = "STL",
                            .encodings = "text, binary",
                            .markers = "lost",
                            .regions = "yes, solids of text files",
                            .quadrilaterals = "become triangles",
                            .volumes = "boundary only, a solid for each marker in text",
                            .polygons = true,  // cut into triangles
                            .keeps_markers = false,
                            .has_binary = true,
                            .recognise = recognise_stl,
                            .read = read_stl,
                            .write = write_stl};

}  // namespace winslow::io::surface
