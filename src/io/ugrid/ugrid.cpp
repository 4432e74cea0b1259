#include "io/ugrid/ugrid.h"

#include <cstring>
#include <set>

#include "io/file/gzip.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io::ugrid {
namespace {

constexpr std::size_t header_numbers = 7;

std::filesystem::path without_gzip(const std::filesystem::path& path) {
  return is_gzip_name(path) ? path.parent_path() / path.stem() : path;
}

/// Smallest size of a file with these counts, in bytes; 0 for impossible counts.
std::uint64_t size_of(const std::array<std::int64_t, header_numbers>& counts, bool single) {
  const std::uint64_t point = single ? 12 : 24;
  const std::array<std::uint64_t, header_numbers> bytes{point, 16, 20, 16, 20, 24, 32};
  std::uint64_t size = header_numbers * 4;
  for (std::size_t k = 0; k < header_numbers; ++k) {
    if (counts[k] < 0) return 0;
    size += static_cast<std::uint64_t>(counts[k]) * bytes[k];
  }
  return counts[0] > 0 ? size : 0;
}

/// True for the first line of a text file: seven numbers; the first one (nodes) is not zero.
bool is_text_header(std::string_view line) {
  std::size_t n = 0;
  while (!line.empty()) {
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    const auto number = parse_integer(line.substr(0, end));
    if (!number || *number < 0 || (n == 0 && *number == 0)) return false;
    ++n;
    line = trimmed(line.substr(end));
  }
  return n == header_numbers;
}

Evidence recognise(const Content& content) {
  const auto encoding = encoding_of_content(content.whole);
  if (!encoding) return {};
  return {encoding->binary ? Evidence::Kind::size : Evidence::Kind::keyword};
}

}  // namespace

std::optional<Encoding> encoding_of_name(const std::filesystem::path& path) {
  const std::string extension = without_gzip(path).stem().extension().string();
  if (extension == ".b8") return Encoding{true, true, false};
  if (extension == ".lb8") return Encoding{true, false, false};
  if (extension == ".b4") return Encoding{true, true, true};
  if (extension == ".lb4") return Encoding{true, false, true};
  return std::nullopt;
}

std::optional<Encoding> encoding_of_content(std::string_view content) {
  if (is_text_header(Content(content).first_line)) return Encoding{};
  if (content.size() < header_numbers * 4) return std::nullopt;
  for (const bool big_endian : {true, false}) {
    std::array<std::int64_t, header_numbers> counts{};
    for (std::size_t k = 0; k < header_numbers; ++k) {
      std::uint32_t value = 0;
      std::memcpy(&value, content.data() + 4 * k, sizeof value);
      if (big_endian) value = __builtin_bswap32(value);
      counts[k] = static_cast<std::int32_t>(value);
    }
    for (const bool single : {false, true}) {
      if (size_of(counts, single) == content.size()) return Encoding{true, big_endian, single};
    }
  }
  return std::nullopt;
}

std::filesystem::path mapbc_path(const std::filesystem::path& path) {
  std::filesystem::path base = without_gzip(path).replace_extension();
  if (encoding_of_name(path)) base.replace_extension();
  base += ".mapbc";
  return base;
}

const MeshFormat format{.name = "ugrid",
                        .title = "AFLR3",
                        .versions = "UGRID with .mapbc",
                        .encodings = "text, binary (.b8.ugrid, .lb8.ugrid, .b4.ugrid, .lb4.ugrid)",
                        .markers = "yes, tag, and name in .mapbc",
                        .regions = "no",
                        .quadrilaterals = "no plane meshes",
                        .writes = {false, false, true},
                        .has_binary = true,
                        .recognise = recognise,
                        .read = read,
                        .files = files};

namespace {

int small_integer(Scanner& scan, const Expected& expected) {
  const std::size_t start = scan.offset();
  const std::int64_t value = scan.integer(expected);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    scan.source().fail(start, std::to_string(value), expected.text());
  return static_cast<int>(value);
}

/// The name in the rest of a line.
std::string name_in(std::string_view rest) {
  std::string_view name = trimmed(rest.substr(0, rest.find('!')));
  for (const char quote : {'"', '\''}) {
    const bool quoted = name.size() > 2 && name.front() == quote && name.back() == quote;
    if (quoted) return std::string(name.substr(1, name.size() - 2));
  }
  return std::string(name);
}

}  // namespace

Mapbc read_mapbc(Source& source, const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  const Source::Range range = source.append(path);
  Scanner scan(source, range.begin, range.end);
  Mapbc mapbc;
  mapbc.text = source.text().substr(range.begin, range.end - range.begin);
  std::set<int> tags;
  scan.skip_space();
  const Index n = scan.count({"the number of surfaces"}, 4);
  scan.line();
  for (Index i = 0; i < n; ++i) {
    scan.skip_space();
    const std::size_t start = scan.offset();
    Surface surface;
    surface.tag = small_integer(scan, {"the number of surface", i, n});
    surface.boundary_condition = small_integer(scan, {"the boundary condition of surface", i, n});
    surface.name = name_in(scan.line());
    const std::string_view text = source.text();
    surface.line = trimmed(text.substr(start, text.find('\n', start) - start));
    if (!tags.insert(surface.tag).second)
      source.fail(start, "surface " + std::to_string(surface.tag) + " a second time", "each once");
    mapbc.surfaces.push_back(std::move(surface));
  }
  return mapbc;
}

std::string mapbc_name(const std::string& name) {
  const std::string line = within_line(name, "!");
  return line.empty() || name_in(line) == line ? line : '"' + line + '"';
}

void write_mapbc(std::ostream& stream, const std::vector<Surface>& surfaces) {
  TextWriter out(stream);
  out << surfaces.size() << '\n';
  for (const Surface& surface : surfaces) {
    if (surface.line.empty())
      out << surface.tag << ' ' << surface.boundary_condition << ' ' << mapbc_name(surface.name);
    else
      out << surface.line;
    out << '\n';
  }
}

}  // namespace winslow::io::ugrid
