#include <limits>

#include "io/surface/surface.h"
#include "io/text/numbers.h"
#include "io/text/scanner.h"
#include "io/text/text_writer.h"

namespace winslow::io::surface {
namespace {

/// What a keyword says that a mesh does not hold; empty: nothing.
std::string dropped_with(std::string_view word) {
  if (word == "vn") return "normals";
  if (word == "vt" || word == "vp") return "texture coordinates";
  if (word == "g" || word == "o") return "groups";
  if (word == "usemtl" || word == "mtllib") return "materials";
  return {};
}

bool known_keyword(std::string_view word) {
  return word == "p" || word == "s" || !dropped_with(word).empty() || word.front() == '#';
}

/// One corner of a face: "7", "7/1", "7//3" or "7/1/3"; counted from 1, or back from the last
/// vertex so far if negative.
Index corner(const Scanner& scan, std::string_view word, Index vertices) {
  const auto number = parse_integer(word.substr(0, word.find('/')));
  if (!number || *number == 0 || *number > std::numeric_limits<Index>::max() ||
      *number < -static_cast<std::int64_t>(vertices)) {
    scan.fail(word, "the number of a vertex");
  }
  return static_cast<Index>(*number > 0 ? *number - 1 : vertices + *number);
}

}  // namespace

ParsedMesh read_obj(Source& source) {
  Scanner scan(source);
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
    scan.line();
  }
  if (lines) builder.mesh().warnings.emplace_back("line elements are not kept");
  return builder.finish();
}

std::vector<std::string> write_obj(std::ostream& stream, const Mesh& mesh,
                                   const FormatDetails* source) {
  TextWriter out(stream);
  const WrittenSurface surface(mesh, source);
  for (Index i = 0; i < surface.node_count(); ++i) {
    const Vec3 p = surface.node(i);
    out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  for (const WrittenSurface::Group& group : surface.groups()) {
    if (!group.name.empty()) out << "g " << one_word(group.name) << '\n';
    for (std::size_t f = group.first; f < group.first + group.count; ++f) {
      out << 'f';
      for (const Index node : surface.faces()[f]) out << ' ' << node + 1;
      out << '\n';
    }
  }
  return lost_in_surface(mesh, true);
}

}  // namespace winslow::io::surface
