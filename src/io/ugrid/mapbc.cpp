#include "io/ugrid/mapbc.h"

#include <limits>
#include <set>
#include <utility>

#include "io/text/scanner.h"
#include "io/text/text_writer.h"

namespace winslow::io::ugrid {
namespace {

int small_integer(Scanner& scan, const Expected& expected) {
  const std::size_t at = scan.offset();
  const std::int64_t value = scan.integer(expected);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    scan.source().fail(at, std::to_string(value), expected.text());
  return static_cast<int>(value);
}

}  // namespace

std::vector<Surface> read_mapbc(Source& source, const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  const Source::Range range = source.append(path);
  Scanner scan(source, range.begin, range.end);
  std::vector<Surface> surfaces;
  std::set<int> tags;
  scan.skip_space();
  const Index n = scan.count({"the number of surfaces"}, 4);
  scan.line();
  for (Index i = 0; i < n; ++i) {
    scan.skip_space();
    const std::size_t at = scan.offset();
    Surface surface;
    surface.tag = small_integer(scan, {"the number of surface", i, n});
    surface.boundary_condition = small_integer(scan, {"the boundary condition of surface", i, n});
    surface.name = scan.word();
    scan.line();
    if (!tags.insert(surface.tag).second)
      source.fail(at, "surface " + std::to_string(surface.tag) + " a second time", "each once");
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

std::string safe_surface_name(const std::string& name) {
  std::string safe = name;
  for (char& c : safe) {
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  }
  return safe;
}

void write_mapbc(std::ostream& stream, const std::vector<Surface>& surfaces) {
  TextWriter out(stream);
  out << surfaces.size() << '\n';
  for (const Surface& surface : surfaces)
    out << surface.tag << ' ' << surface.boundary_condition << ' ' << surface.name << '\n';
}

}  // namespace winslow::io::ugrid
