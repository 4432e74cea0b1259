#include <array>

#include "io/surface/surface.h"
#include "io/text/scanner.h"
#include "io/text/text_writer.h"

namespace winslow::io::surface {
namespace {

/// Goes to the next line that holds data.
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
  // C, N and ST announce columns after the coordinates, which we skip; 4 and n are other spaces.
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

}  // namespace

ParsedMesh read_off(Source& source) {
  Scanner scan(source);
  Builder builder(source);
  read_header(scan, builder);
  begin_record(scan, {"the number of vertices"});
  const Index vertices = scan.count({"the number of vertices"}, 4);
  const Index faces = scan.count({"the number of faces"}, 4);
  scan.line();
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
    std::array<Index, 4> corners{};
    if (size != 3 && size != 4) {
      source.fail(offset, "a face with " + std::to_string(size) + " corners",
                  "a triangle or a quadrilateral");
    }
    for (Index k = 0; k < size; ++k) {
      corners[static_cast<std::size_t>(k)] = scan.index({"a vertex of face", f, faces});
    }
    builder.add_face({corners.data(), static_cast<std::size_t>(size)}, offset);
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
                                   const FormatDetails* source) {
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

}  // namespace winslow::io::surface
