#include "io/surface/surface.h"

#include <Eigen/Geometry>
#include <cstring>

#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io::surface {

void Builder::add_vertex(double x, double y, double z, std::size_t offset) {
  xyz_.insert(xyz_.end(), {x, y, z});
  mesh_.where.nodes.push_back(offset);
}

void Builder::add_face(std::span<const Index> corners, std::size_t offset) {
  require_corners(corners.size(), offset);
  const ElementType type = corners.size() == 3   ? ElementType::triangle
                           : corners.size() == 4 ? ElementType::quadrilateral
                                                 : ElementType::polygon;
  polygons_ |= type == ElementType::polygon;
  mesh_.data.add_element(type, corners);
  mesh_.where.elements.push_back(offset);
}

void Builder::require_corners(std::size_t count, std::size_t offset) const {
  if (count >= 3 && count <= most_polygon_corners) return;
  source_.fail(offset, "a face with " + std::to_string(count) + " corners",
               "3 to " + std::to_string(most_polygon_corners));
}

ParsedMesh Builder::finish(bool binary) {
  if (mesh_.data.types.empty()) source_.fail(source_.text().size(), "no faces", "a mesh");
  // Beside polygons, one with four corners may be a triangle with a hanging node.
  if (polygons_)
    std::ranges::replace(mesh_.data.types, ElementType::quadrilateral, ElementType::polygon);
  set_nodes(source_, xyz_, mesh_);
  mesh_.details->binary = binary;
  for (const std::string& what : dropped_)
    mesh_.warnings.push_back(what + " of the file are not kept");
  return std::move(mesh_);
}

WrittenSurface::WrittenSurface(const Mesh& mesh, const FormatDetails* details)
    : space_(mesh, details), plane_(mesh.topology->space_dimension() == 2) {
  const Topology& topology = *mesh.topology;
  if (topology.cell_dimension() == 3) {
    add_boundary(topology);
    return;
  }
  nodes_.resize(static_cast<std::size_t>(topology.node_count()));
  std::iota(nodes_.begin(), nodes_.end(), 0);
  for (Index e = 0; e < topology.element_count(); ++e) faces_.push_back(space_.element(e));
  groups_.push_back({{}, 0, faces_.size()});
}

void WrittenSurface::add_boundary(const Topology& topology) {
  std::vector<bool> taken(static_cast<std::size_t>(topology.face_count()), false);
  std::vector<Index> number(static_cast<std::size_t>(topology.node_count()), -1);
  const auto add = [&](Index f) {
    const auto [face, elements] = topology.face(f);
    if (elements[1] >= 0 || taken[static_cast<std::size_t>(f)]) return;
    taken[static_cast<std::size_t>(f)] = true;
    FileCorners corners({face.begin(), face.size()});
    for (Index& node : corners.span()) {
      Index& own = number[static_cast<std::size_t>(node)];
      if (own < 0) {
        own = node_count();
        nodes_.push_back(node);
      }
      node = own;
    }
    faces_.push_back(corners);
  };
  if (topology.markers().from_file()) {
    for (const Marker& marker : topology.markers()) {
      const std::size_t first = faces_.size();
      for (const Face& face : marker.faces) add(*topology.find_face(face));
      if (faces_.size() > first) groups_.push_back({marker.name, first, faces_.size() - first});
    }
  }
  const std::size_t first = faces_.size();
  for (Index f = 0; f < topology.face_count(); ++f) add(f);
  if (faces_.size() > first) groups_.push_back({"boundary", first, faces_.size() - first});
}

Vec3 WrittenSurface::normal(const FileCorners& corners) const {
  if (plane_) return space_.normal();
  if (corners.size() > 4) return normal_of_polygon(corners);
  // Use the diagonals of a quadrilateral, because it need not be planar.
  const Vec3 a = node(corners[2]) - node(corners[0]);
  const Vec3 b = node(corners[corners.size() - 1]) - node(corners[1]);
  const Vec3 n = corners.size() == 3 ? (node(corners[1]) - node(corners[0])).cross(a) : a.cross(b);
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

Vec3 WrittenSurface::normal_of_polygon(const FileCorners& corners) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += (node(corners[k]) - node(corners[0])).cross(node(corners[k + 1]) - node(corners[0]));
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

std::vector<std::string> lost_in_surface(const Mesh& mesh, bool keeps_groups, bool keeps_regions) {
  std::vector<std::string> warnings;
  const bool volume = mesh.topology->cell_dimension() == 3;
  if (volume) warnings.emplace_back("this format holds surfaces: only the boundary is written");
  const bool kept = volume && keeps_groups;
  if (!kept && mesh.topology->markers().from_file() && !mesh.topology->markers().empty()) {
    warnings.emplace_back("this format has no markers: they are lost");
  }
  if (!mesh.topology->regions().empty() && (volume || !keeps_regions)) {
    warnings.emplace_back("this format has no regions: the names of element sets are lost");
  }
  return warnings;
}

namespace {

bool begins_with_any(std::string_view line, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](auto word) { return starts_with_word(line, word); });
}

bool is_obj_keyword(std::string_view line) {
  return begins_with_any(line, {"v", "f", "vn", "vt", "mtllib", "usemtl"});
}

/// The content behind a keyword that a mesh cannot hold; empty: none.
std::string dropped_with(std::string_view word) {
  if (word == "vn") return "normals";
  if (word == "vt" || word == "vp") return "texture coordinates";
  if (word == "g" || word == "o") return "groups";
  if (word == "usemtl" || word == "mtllib") return "materials";
  return {};
}

bool known_keyword(std::string_view word) {
  return word.empty() || word == "p" || word == "s" || !dropped_with(word).empty() ||
         word.front() == '#';
}

/// One corner of a face: "7", "7/1", "7//3" or "7/1/3"; counted from 1, or, if negative, backwards
/// from the last vertex so far.
Index corner(const Scanner& scan, std::string_view word, Index vertices) {
  const auto number = parse_integer(word.substr(0, word.find('/')));
  if (!number || *number == 0 || *number > std::numeric_limits<Index>::max() ||
      *number < -static_cast<std::int64_t>(vertices)) {
    scan.fail(word, "the number of a vertex");
  }
  return static_cast<Index>(*number > 0 ? *number - 1 : vertices + *number);
}

/// Reads statements of an OBJ file. A backslash at the end of a line continues the statement on
/// the next line.
class ObjScanner : public Scanner {
 public:
  using Scanner::Scanner;

  /// The next word of the statement; empty at its end.
  std::string_view word() {
    auto found = Scanner::word();
    while (found == "\\" && rest_is_blank()) {
      Scanner::line();
      found = Scanner::word();
    }
    // The backslash may follow a word without a blank.
    if (found.size() > 1 && found.back() == '\\' && rest_is_blank()) {
      found.remove_suffix(1);
      seek(source().offset_of(found) + found.size());
    }
    return found;
  }

  double number(const Expected& expected) {
    const auto found = word();
    const auto value = parse_number(found);
    if (!value) fail(found, expected);
    return *value;
  }

  /// Skips the rest of the statement.
  void end() {
    for (;;) {
      const auto rest = trimmed(line());
      if (!rest.ends_with('\\')) return;
    }
  }

 private:
  bool rest_is_blank() {
    const std::size_t here = offset();
    const bool blank = trimmed(line()).empty();
    seek(here);
    return blank;
  }
};

ParsedMesh read_obj(Source& source) {
  ObjScanner scan(source);
  Builder builder(source);
  std::vector<Index> corners;
  bool lines = false;
  for (scan.skip_space(); !scan.at_end(); scan.skip_space()) {
    const std::size_t offset = scan.offset();
    const auto keyword = scan.word();
    if (keyword == "v") {
      const Expected expected{"a coordinate of vertex", builder.vertices()};
      const double x = scan.number(expected);
      const double y = scan.number(expected);
      builder.add_vertex(x, y, scan.number(expected), offset);
      const auto more = scan.word();
      const bool weight = scan.word().empty();  // x y z w, or x y z r g b
      if (!more.empty() && more.front() != '#' && !weight) builder.drops("colours");
    } else if (keyword == "f") {
      corners.clear();
      for (auto word = scan.word(); !word.empty() && word.front() != '#'; word = scan.word()) {
        corners.push_back(corner(scan, word, builder.vertices()));
      }
      builder.add_face(corners, offset);
    } else if (keyword == "l") {
      lines = true;
    } else if (const auto dropped = dropped_with(keyword); !dropped.empty()) {
      builder.drops(dropped);
    } else if (!known_keyword(keyword)) {
      scan.fail(keyword, "v, f or another keyword of an OBJ file");
    }
    // A comment may end in a backslash, as names of Windows folders do.
    if (keyword.starts_with('#'))
      scan.line();
    else
      scan.end();
  }
  if (lines) builder.mesh().warnings.emplace_back("line elements are not kept");
  return builder.finish();
}

std::vector<std::string> write_obj(std::ostream& stream, const Mesh& mesh,
                                   const FormatDetails* source, const WriteOptions&) {
  TextWriter out(stream);
  const WrittenSurface surface(mesh, source);
  for (Index i = 0; i < surface.node_count(); ++i) {
    const Vec3 p = surface.node(i);
    out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  for (const WrittenSurface::Group& group : surface.groups()) {
    if (!group.name.empty()) out << "g " << as_word(group.name) << '\n';
    for (std::size_t f = group.first; f < group.first + group.count; ++f) {
      out << 'f';
      for (const Index node : surface.faces()[f]) out << ' ' << node + 1;
      out << '\n';
    }
  }
  return lost_in_surface(mesh, true);
}

/// Moves to the next line with data.
void begin_record(Scanner& scan, const Expected& expected) {
  for (;;) {
    scan.skip_space();
    if (scan.at_end()) scan.fail(scan.source().text().substr(scan.offset()), expected);
    if (scan.source().text()[scan.offset()] != '#') return;
    scan.line();
  }
}

void read_header(Scanner& scan, Builder& builder) {
  begin_record(scan, {"OFF"});
  const std::size_t begin = scan.offset();
  const auto magic = scan.word();
  // C, N and ST announce columns after the coordinates, which are skipped; 4 and n mean other space
  // dimensions.
  for (const std::string_view known : {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}) {
    if (magic != known) continue;
    const auto columns = known.substr(0, known.size() - 3);
    if (columns.find('C') != std::string_view::npos) builder.drops("colours");
    if (columns.find('N') != std::string_view::npos) builder.drops("normals");
    if (columns.starts_with("ST")) builder.drops("texture coordinates");
    const std::size_t here = scan.offset();
    if (scan.word() == "BINARY") scan.source().fail(begin, "a binary OFF file", "an ASCII one");
    scan.seek(here);
    return;
  }
  scan.fail(magic, "OFF, COFF or NOFF");
}

ParsedMesh read_off(Source& source) {
  Scanner scan(source);
  Builder builder(source);
  read_header(scan, builder);
  begin_record(scan, {"the number of vertices"});
  const Index vertices = scan.count({"the number of vertices"}, 4);
  const Index faces = scan.count({"the number of faces"}, 4);
  scan.line();
  std::vector<Index> corners;
  for (Index i = 0; i < vertices; ++i) {
    const Expected expected{"vertex", i, vertices};
    begin_record(scan, expected);
    const std::size_t offset = scan.offset();
    const double x = scan.number(expected);
    const double y = scan.number({"y of vertex", i, vertices});
    builder.add_vertex(x, y, scan.number({"z of vertex", i, vertices}), offset);
    scan.line();
  }
  for (Index f = 0; f < faces; ++f) {
    const Expected expected{"face", f, faces};
    begin_record(scan, expected);
    const std::size_t offset = scan.offset();
    const Index size = scan.index({"the number of corners of face", f, faces});
    builder.require_corners(static_cast<std::size_t>(size), offset);
    corners.clear();
    for (Index k = 0; k < size; ++k) corners.push_back(scan.index({"a vertex of face", f, faces}));
    builder.add_face(corners, offset);
    const auto more = scan.word();
    if (!more.empty() && more.front() != '#') builder.drops("colours");
    scan.line();
  }
  scan.skip_space();
  const auto rest = scan.word();
  if (!rest.empty() && rest.front() != '#') scan.fail(rest, "the end of the file after all faces");
  return builder.finish();
}

std::vector<std::string> write_off(std::ostream& stream, const Mesh& mesh,
                                   const FormatDetails* source, const WriteOptions&) {
  TextWriter out(stream);
  const WrittenSurface surface(mesh, source);
  out << "OFF\n" << surface.node_count() << ' ' << surface.faces().size() << " 0\n";
  for (Index i = 0; i < surface.node_count(); ++i) {
    const Vec3 p = surface.node(i);
    out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  for (const FileCorners& corners : surface.faces()) {
    out << corners.size();
    for (const Index node : corners) out << ' ' << node;
    out << '\n';
  }
  return lost_in_surface(mesh);
}

}  // namespace

const MeshFormat obj_format{
    .name = "obj",
    .title = "Wavefront",
    .markers = "lost",
    .regions = "lost",
    .volumes = "boundary only, a group for each marker",
    .polygons = true,
    .keeps_markers = false,
    .recognise = [](const Content& content) { return keyword_on_line(content, is_obj_keyword); },
    .read = read_obj,
    .write = write_obj};

const MeshFormat off_format{
    .name = "off",
    .title = "Object File Format",
    .markers = "lost",
    .regions = "lost",
    .volumes = "boundary only",
    .polygons = true,
    .keeps_markers = false,
    .recognise =
        [](const Content& content) {
          return signature_if(begins_with_any(
              content.first_line, {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}));
        },
    .read = read_off,
    .write = write_off};

}  // namespace winslow::io::surface

namespace winslow::io {

MeshCounts written_counts(const std::filesystem::path& path, const Mesh& mesh,
                          const FormatDetails* details) {
  const Topology& topology = *mesh.topology;
  const MeshFormat* format = format_of_extension(path);
  if (format == nullptr || format->keeps_markers) {
    return {topology.node_count(), topology.element_count(),
            topology.markers().from_file() ? topology.markers().size() : 0};
  }
  const surface::WrittenSurface surface(mesh, details);
  const bool triangles = format == &surface::stl_format;
  MeshCounts counts{surface.node_count(), 0, 0};
  for (const FileCorners& face : surface.faces())
    counts.elements += triangles ? static_cast<Index>(face.size()) - 2 : 1;
  return counts;
}

}  // namespace winslow::io
