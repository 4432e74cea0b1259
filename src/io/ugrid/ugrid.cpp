#include "io/ugrid/ugrid.h"

#include <cstdlib>
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

std::uint64_t content_size(const std::array<std::int64_t, header_numbers>& counts,
                           const Encoding& encoding) {
  const std::uint64_t integer = encoding.integer_bytes();
  // Of nodes the coordinates, of boundary faces the corners and the surface, of elements corners.
  const std::array<std::uint64_t, header_numbers> bytes{3 * encoding.real_bytes(),
                                                        4 * integer,
                                                        5 * integer,
                                                        4 * integer,
                                                        5 * integer,
                                                        6 * integer,
                                                        8 * integer};
  constexpr std::int64_t most = std::int64_t{1} << 40;  // sums stay far from overflow
  std::uint64_t size = header_numbers * integer;
  for (std::size_t k = 0; k < header_numbers; ++k) {
    if (counts[k] < 0 || counts[k] > most) return 0;
    size += static_cast<std::uint64_t>(counts[k]) * bytes[k];
  }
  return counts[0] > 0 ? size : 0;
}

std::vector<Record> find_records(std::string_view content, bool big_endian) {
  const auto length_at = [&](std::size_t offset) {
    return number_at<std::int64_t>(content.data() + offset, {false, true, 4}, big_endian);
  };
  std::vector<Record> records;
  for (std::size_t begin = 0; begin < content.size();) {
    if (content.size() - begin < 8) return {};
    const auto length = static_cast<std::size_t>(std::abs(length_at(begin)));
    if (length > content.size() - begin - 8) return {};
    const std::size_t end = begin + 4 + length;
    if (static_cast<std::size_t>(std::abs(length_at(end))) != length) return {};
    records.push_back({begin + 4, end});
    begin = end + 4;
  }
  return records;
}

std::optional<Encoding> encoding_of_name(const std::filesystem::path& path) {
  const std::string extension = without_gzip(path).stem().extension().string();
  std::string_view letters = extension;
  const auto skips = [&](std::string_view wanted) {
    const bool found = letters.starts_with(wanted);
    if (found) letters.remove_prefix(wanted.size());
    return found;
  };
  if (!skips(".")) return std::nullopt;
  Encoding encoding{true};
  encoding.big_endian = !skips("l");
  encoding.records = skips("r");
  if (!encoding.records && !skips("b")) return std::nullopt;
  encoding.single = skips("4");
  if (!encoding.single && !skips("8")) return std::nullopt;
  encoding.wide = skips("l");
  return letters.empty() ? std::optional(encoding) : std::nullopt;
}

namespace {

/// True if the counts that the content has in this encoding fit its size.
bool fits_size(std::string_view content, const Encoding& encoding) {
  const std::size_t header = header_numbers * encoding.integer_bytes();
  std::uint64_t size = content.size();
  std::size_t begin = 0;
  if (encoding.records) {
    const std::vector<Record> records = find_records(content, encoding.big_endian);
    if (records.empty() || records.front().end - records.front().begin < header) return false;
    begin = records.front().begin;
    size = 0;
    for (const Record& record : records) size += record.end - record.begin;
  }
  if (size < header) return false;
  std::array<std::int64_t, header_numbers> counts{};
  for (std::size_t k = 0; k < header_numbers; ++k) {
    counts[k] =
        number_at<std::int64_t>(content.data() + begin + k * encoding.integer_bytes(),
                                {false, true, encoding.integer_bytes()}, encoding.big_endian);
  }
  return content_size(counts, encoding) == size;
}

}  // namespace

std::optional<Encoding> encoding_of_content(std::string_view content) {
  if (is_text_header(Content(content).first_line)) return Encoding{};
  for (const bool wide : {false, true}) {
    for (const bool records : {false, true}) {
      for (const bool big_endian : {true, false}) {
        for (const bool single : {false, true}) {
          const Encoding encoding{true, big_endian, single, records, wide};
          if (fits_size(content, encoding)) return encoding;
        }
      }
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
                        .encodings =
                            "text, binary (.b8.ugrid, .lb8.ugrid, .b4.ugrid, .lb4.ugrid), "
                            "records of Fortran (.r8.ugrid, .lr8.ugrid, ...), 64-bit "
                            "integers (.b8l.ugrid, .lb8l.ugrid, .lr8l.ugrid, ...)",
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
