#include <cstring>

#include "io/text/numbers.h"
#include "io/text/source.h"
#include "io/vtk/grid.h"

namespace winslow::io::vtk {

namespace {

/// Type of the numbers of a legacy array.
struct NumberType {
  enum class Kind : std::uint8_t { floating, signed_integer, unsigned_integer, bit, text };
  Kind kind;
  std::size_t bytes;
};
using Kind = NumberType::Kind;

std::optional<NumberType> number_type(std::string_view name) {
  struct Named {
    std::string_view name;
    NumberType type;
  };
  static constexpr std::array<Named, 19> types{{
      {"bit", {Kind::bit, 1}},
      {"unsigned_char", {Kind::unsigned_integer, 1}},
      {"char", {Kind::signed_integer, 1}},
      {"signed_char", {Kind::signed_integer, 1}},
      {"unsigned_short", {Kind::unsigned_integer, 2}},
      {"short", {Kind::signed_integer, 2}},
      {"unsigned_int", {Kind::unsigned_integer, 4}},
      {"int", {Kind::signed_integer, 4}},
      {"unsigned_long", {Kind::unsigned_integer, 8}},
      {"long", {Kind::signed_integer, 8}},
      {"unsigned_long_long", {Kind::unsigned_integer, 8}},
      {"long_long", {Kind::signed_integer, 8}},
      {"vtktypeint64", {Kind::signed_integer, 8}},
      {"vtktypeuint64", {Kind::unsigned_integer, 8}},
      {"vtktypeint32", {Kind::signed_integer, 4}},
      // Legacy files hold ids as 32-bit integers, whatever their width in memory.
      {"vtkIdType", {Kind::signed_integer, 4}},
      {"float", {Kind::floating, 4}},
      {"double", {Kind::floating, 8}},
      {"string", {Kind::text, 1}},
  }};
  const std::string lower = name == "vtkIdType" ? std::string(name) : lower_case(name);
  for (const Named& known : types) {
    if (known.name == lower) return known.type;
  }
  return std::nullopt;
}

/// Reads the arrays of a legacy file: numbers separated by white space, or big-endian bytes.
class LegacyArrays {
 public:
  explicit LegacyArrays(Scanner& scan) : scan_(scan) {}

  bool binary() const { return binary_; }
  void set_binary(bool binary) { binary_ = binary; }
  /// Next word of this line as a type. Throws InputError.
  NumberType type() {
    const auto word = scan_.word();
    const auto found = number_type(word);
    if (!found) scan_.fail(word, "a type such as float, double or int");
    return *found;
  }

  /// Checks a count read by the caller against the bytes left.
  Index count(const Expected& expected, const NumberType& type, std::size_t numbers_each) {
    return scan_.count(
        expected, std::max<std::size_t>(1, binary_ ? numbers_each * type.bytes : numbers_each * 2));
  }

  /// Reads numbers; `places`, if given, receives the byte offset of each.
  std::vector<double> numbers(std::size_t n, NumberType type, const Expected& expected,
                              std::vector<std::size_t>* places = nullptr) {
    if (type.kind == Kind::text) {
      skip_strings(n, expected);
      return {};
    }
    if (binary_) begin_bytes(type.kind == Kind::bit ? (n + 7) / 8 : n, type, expected);
    if (n / 2 > scan_.bytes_left() + 1 && !binary_) {
      scan_.source().fail(scan_.offset(), "too few numbers", expected.text());
    }
    if (binary_ && type.kind == Kind::bit) {
      scan_.seek(scan_.offset() + (n + 7) / 8);
      return {};
    }
    return read<double>(n, type, expected, places);
  }
  std::vector<std::int64_t> integers(std::size_t n, NumberType type, const Expected& expected,
                                     std::vector<std::size_t>* places = nullptr) {
    if (type.kind != Kind::signed_integer && type.kind != Kind::unsigned_integer) {
      scan_.source().fail(scan_.offset(), "an array that is not of integers", expected.text());
    }
    if (binary_) begin_bytes(n, type, expected);
    return read<std::int64_t>(n, type, expected, places);
  }

  /// Skips n strings. In binary, the two top bits of the first byte give the number of bytes of the
  /// length.
  void skip_strings(std::size_t n, const Expected& expected) {
    const auto text = scan_.source().text();
    for (std::size_t i = 0; i < n; ++i) {
      if (scan_.at_end()) scan_.source().fail(text.size(), "the end of the file", expected.text());
      if (!binary_) {
        scan_.line();
        continue;
      }
      const auto first = static_cast<unsigned char>(text[scan_.offset()]);
      const std::size_t width = std::size_t{1} << (3 - (first >> 6));
      if (scan_.bytes_left() < width) {
        scan_.source().fail(text.size(), "the end of the file", expected.text());
      }
      const std::uint64_t mask = ~std::uint64_t{0} >> (64 - 8 * width + 2);
      const std::uint64_t length = unsigned_at(text.data() + scan_.offset(), width, true) & mask;
      if (length > scan_.bytes_left() - width) {
        scan_.source().fail(scan_.offset(), "a string longer than the file", expected.text());
      }
      scan_.seek(scan_.offset() + width + static_cast<std::size_t>(length));
    }
  }

 private:
  void begin_bytes(std::size_t n, NumberType type, const Expected& expected) {
    const std::size_t size = type.kind == Kind::bit ? (n + 7) / 8 : n * type.bytes;
    if (n > scan_.bytes_left() || size > scan_.bytes_left()) {
      scan_.source().fail(scan_.source().text().size(), "the end of the file", expected.text());
    }
  }

  template <class Number>
  std::vector<Number> read(std::size_t n, NumberType type, const Expected& expected,
                           std::vector<std::size_t>* places) {
    const BinaryNumber kind{type.kind == Kind::floating, type.kind != Kind::unsigned_integer,
                            type.bytes};
    std::vector<Number> values;
    values.reserve(std::min(n, scan_.bytes_left()));
    for (std::size_t i = 0; i < n; ++i) {
      if (binary_) {
        if (places != nullptr) places->push_back(scan_.offset());
        values.push_back(scan_.bytes<Number>(kind, true, expected));
        continue;
      }
      const auto word = scan_.next_word();
      const auto value = parse<Number>(word);
      if (!value) scan_.fail(word, expected);
      if (places != nullptr) places->push_back(scan_.source().offset_of(word));
      values.push_back(*value);
    }
    return values;
  }

  Scanner& scan_;
  bool binary_ = false;
};

constexpr NumberType int32{NumberType::Kind::signed_integer, 4};

/// Decodes a name: VTK writes white space as "%20".
std::string decoded(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto digit = [&](std::size_t k) {
      const char c = k < name.size() ? name[k] : 'x';
      if (c >= '0' && c <= '9') return c - '0';
      if (c >= 'A' && c <= 'F') return c - 'A' + 10;
      return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
    };
    if (name[i] == '%' && digit(i + 1) >= 0 && digit(i + 2) >= 0) {
      text += static_cast<char>(16 * digit(i + 1) + digit(i + 2));
      i += 2;
    } else {
      text += name[i];
    }
  }
  return text;
}

class LegacyReader {
 public:
  explicit LegacyReader(Source& source) : source_(source), scan_(source), arrays_(scan_) {}

  ParsedMesh read() {
    read_header();
    for (auto word = scan_.next_word(); !word.empty(); word = scan_.next_word()) {
      read_section(word);
    }
    finish();
    ParsedMesh mesh = to_mesh(source_, grid_);
    mesh.details->binary = arrays_.binary();
    return mesh;
  }

 private:
  void read_header() {
    const auto first = scan_.line();
    if (!first.starts_with("# vtk DataFile Version")) {
      source_.fail(0, in_quotes(first), "# vtk DataFile Version ...");
    }
    scan_.line();
    const auto encoding = scan_.next_word();
    if (encoding != "ASCII" && encoding != "BINARY") scan_.fail(encoding, "ASCII or BINARY");
    scan_.end_line({"the end of the line"});
    const bool binary = encoding == "BINARY";
    if (binary) source_.set_binary_from(scan_.offset());
    arrays_.set_binary(binary);
    const auto word = scan_.next_word();
    if (word != "DATASET") scan_.fail(word, "DATASET");
    const auto kind = scan_.word();
    polygons_ = kind == "POLYDATA";
    if (kind != "UNSTRUCTURED_GRID" && !polygons_) {
      scan_.fail(kind, "UNSTRUCTURED_GRID or POLYDATA");
    }
    scan_.end_line({"the end of the line"});
  }

  void read_section(std::string_view word) {
    if (word == "FIELD") return read_field();
    if (word == "METADATA") return skip_metadata();
    if (word == "POINTS") return read_points(word);
    if (word == "POINT_DATA") return begin_data(false, point_count_);
    if (word == "CELL_DATA") return begin_data(true, cell_count());
    if (place_ != Place::file) return read_attribute(word);
    if (word == "CELLS" && !polygons_) return read_cells(word, 0);
    if (word == "CELL_TYPES" && !polygons_) return read_types(word);
    if (word == "VERTICES" && polygons_) return read_cells(word, vertex);
    if (word == "LINES" && polygons_) return read_cells(word, poly_line);
    if (word == "POLYGONS" && polygons_) return read_cells(word, polygon);
    if (word == "TRIANGLE_STRIPS") scan_.fail(word, "triangles that are not in strips");
    scan_.fail(word, "a keyword of a VTK file, such as POINTS, CELLS or CELL_DATA");
  }

  std::size_t cell_count() const { return grid_.offsets.size() - 1; }

  void read_points(std::string_view word) {
    if (have_points_) scan_.fail(word, "POINTS only once");
    have_points_ = true;
    const Index n = arrays_.count({"the number of points"}, {NumberType::Kind::floating, 4}, 3);
    const NumberType type = arrays_.type();
    scan_.end_line({"the end of the line"});
    point_count_ = static_cast<std::size_t>(n);
    std::vector<std::size_t> places;
    grid_.points = arrays_.numbers(3 * point_count_, type, {"a coordinate of a point"}, &places);
    if (grid_.points.size() != 3 * point_count_) scan_.fail(word, "coordinates that are numbers");
    for (std::size_t i = 0; i < point_count_; ++i) grid_.point_places.push_back(places[3 * i]);
  }

  /// Reads "CELLS cells numbers" (to version 4: length and nodes of each cell) or "CELLS offsets
  /// nodes" (version 5: OFFSETS and CONNECTIVITY).
  void read_cells(std::string_view word, std::int64_t type) {
    if (type == 0 && have_cells_) scan_.fail(word, "CELLS only once");
    have_cells_ = true;
    const Index n = arrays_.count({"the number of cells"}, int32, 1);
    const Index size = arrays_.count({"the length of the list of cells"}, int32, 1);
    scan_.end_line({"the end of the line"});
    const std::size_t before = cell_count();
    const std::size_t here = scan_.offset();
    const auto next = arrays_.binary() ? scan_.word() : scan_.next_word();
    if (next == "OFFSETS") {
      read_offsets_and_connectivity(static_cast<std::size_t>(n), static_cast<std::size_t>(size));
    } else {
      scan_.seek(here);
      read_cell_list(static_cast<std::size_t>(n), static_cast<std::size_t>(size), here);
    }
    if (type != 0) grid_.types.resize(grid_.types.size() + cell_count() - before, type);
  }

  void read_cell_list(std::size_t n, std::size_t size, std::size_t begin) {
    std::vector<std::size_t> places;
    const auto list = arrays_.integers(size, int32, {"a number in the list of cells"}, &places);
    std::size_t next = 0;
    for (std::size_t c = 0; c < n; ++c) {
      if (next >= size) {
        source_.fail(begin, "a list of " + std::to_string(size) + " numbers",
                     std::to_string(n) + " cells");
      }
      const auto corners = list[next];
      grid_.cell_places.push_back(places[next]);
      if (corners < 0 || static_cast<std::uint64_t>(corners) > size - next - 1) {
        source_.fail(places[next], std::to_string(corners) + " as the size of a cell",
                     "at most what the list holds");
      }
      const auto from = list.begin() + static_cast<std::ptrdiff_t>(next) + 1;
      grid_.connectivity.insert(grid_.connectivity.end(), from, from + corners);
      grid_.offsets.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
      next += static_cast<std::size_t>(corners) + 1;
    }
    if (next != size) {
      source_.fail(begin, std::to_string(size) + " as the length of the list of cells",
                   std::to_string(next));
    }
  }

  void read_offsets_and_connectivity(std::size_t n, std::size_t size) {
    const NumberType offset_type = arrays_.type();
    scan_.end_line({"the end of the line"});
    std::vector<std::size_t> places;
    const auto offsets = arrays_.integers(n, offset_type, {"an offset of a cell"}, &places);
    const auto word = scan_.next_word();
    if (word != "CONNECTIVITY") scan_.fail(word, "CONNECTIVITY");
    const NumberType type = arrays_.type();
    scan_.end_line({"the end of the line"});
    std::vector<std::size_t> node_places;
    const auto nodes = arrays_.integers(size, type, {"a node of a cell"}, &node_places);
    const auto base = static_cast<std::int64_t>(grid_.connectivity.size());
    grid_.connectivity.insert(grid_.connectivity.end(), nodes.begin(), nodes.end());
    for (std::size_t c = 0; c < n; ++c) {
      const bool rising = c == 0 ? offsets[c] == 0 : offsets[c] >= offsets[c - 1];
      if (!rising || offsets[c] > static_cast<std::int64_t>(size)) {
        source_.fail(places[c], std::to_string(offsets[c]) + " as an offset",
                     "offsets that rise from 0 to " + std::to_string(size));
      }
      if (c == 0) continue;
      grid_.offsets.push_back(base + offsets[c]);
      const auto first = static_cast<std::size_t>(offsets[c - 1]);
      grid_.cell_places.push_back(first < node_places.size() ? node_places[first] : places[c]);
    }
    if (n > 0 && offsets.back() != static_cast<std::int64_t>(size)) {
      source_.fail(places.back(), std::to_string(offsets.back()) + " as the last offset",
                   std::to_string(size));
    }
  }

  void read_types(std::string_view word) {
    if (!grid_.types.empty()) scan_.fail(word, "CELL_TYPES only once");
    const Index n = arrays_.count({"the number of cell types"}, int32, 1);
    scan_.end_line({"the end of the line"});
    types_offset_ = scan_.offset();
    grid_.types = arrays_.integers(static_cast<std::size_t>(n), int32, {"a cell type"});
  }

  void begin_data(bool of_cells, std::size_t expected) {
    const std::size_t start = scan_.offset();
    const auto n = scan_.index({"the number of values"});
    scan_.end_line({"the end of the line"});
    place_ = of_cells ? Place::cells : Place::points;
    values_ = static_cast<std::size_t>(n);
    if (values_ != expected) {
      source_.fail(start, "data for " + std::to_string(n) + (of_cells ? " cells" : " points"),
                   std::to_string(expected));
    }
  }

  void read_attribute(std::string_view word) {
    const std::string keyword(word);
    if (keyword == "LOOKUP_TABLE") {
      scan_.word();
      const Index n = scan_.count({"the size of a lookup table"}, arrays_.binary() ? 4 : 8);
      scan_.end_line({"the end of the line"});
      const NumberType type = arrays_.binary() ? NumberType{NumberType::Kind::unsigned_integer, 1}
                                               : NumberType{NumberType::Kind::floating, 4};
      arrays_.numbers(4 * static_cast<std::size_t>(n), type, {"a colour of a lookup table"});
      return;
    }
    const std::string name = decoded(scan_.word());
    std::size_t components = 1;
    NumberType type = int32;
    if (keyword == "COLOR_SCALARS") {
      components = static_cast<std::size_t>(scan_.count({"the number of components"}, 1));
      type = arrays_.binary() ? NumberType{NumberType::Kind::unsigned_integer, 1}
                              : NumberType{NumberType::Kind::floating, 4};
    } else if (keyword == "TEXTURE_COORDINATES") {
      components = static_cast<std::size_t>(scan_.count({"the number of components"}, 1));
      type = arrays_.type();
    } else if (keyword == "SCALARS") {
      type = arrays_.type();
      const auto given = scan_.word();
      const auto number = given.empty() ? 1 : parse_integer(given).value_or(0);
      if (number < 1 || number > 4) scan_.fail(given, "1 to 4 components");
      components = static_cast<std::size_t>(number);
      skip_lookup_table_name();
    } else if (keyword == "VECTORS" || keyword == "NORMALS" || keyword == "TENSORS" ||
               keyword == "TENSORS6" || keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS" ||
               keyword == "EDGE_FLAGS") {
      type = arrays_.type();
      components = keyword == "TENSORS" ? 9 : keyword == "TENSORS6" ? 6 : 3;
      if (keyword.ends_with("IDS") || keyword == "EDGE_FLAGS") components = 1;
    } else {
      scan_.fail(word, "the keyword of a data array, such as SCALARS or FIELD");
    }
    scan_.end_line({"the end of the line"});
    const auto values = arrays_.numbers(values_ * components, type, {"a value of a data array"});
    if (place_ == Place::cells) {
      collector_.cell_array(name, values, components);
    } else {
      grid_.dropped.insert(name);
    }
  }

  /// In most files a separate line between SCALARS and its values names a lookup table.
  void skip_lookup_table_name() {
    const std::size_t here = scan_.offset();
    if (scan_.next_word() == "LOOKUP_TABLE") {
      scan_.word();
    } else {
      scan_.seek(here);
    }
  }

  void read_field() {
    scan_.word();
    const Index n = scan_.count({"the number of arrays of a field"}, 4);
    scan_.end_line({"the end of the line"});
    for (Index a = 0; a < n; ++a) {
      const auto word = scan_.next_word();
      if (word == "METADATA") {
        skip_metadata();
        --a;
        continue;
      }
      if (word.empty()) scan_.fail(word, Expected{"array of a field", a, n});
      const std::string name = decoded(word);
      const auto components = static_cast<std::size_t>(scan_.index({"the number of components"}));
      const auto tuples = static_cast<std::size_t>(scan_.index({"the number of tuples"}));
      const NumberType type = arrays_.type();
      scan_.end_line({"the end of the line"});
      const auto values = arrays_.numbers(components * tuples, type, {"a value of a field array"});
      if (place_ == Place::cells) {
        collector_.cell_array(name, values, components);
      } else if (place_ == Place::file) {
        collector_.field_array(name, values);
      } else {
        grid_.dropped.insert(name);
      }
    }
  }

  /// Skips metadata, which ends at the next empty line, also in binary files.
  void skip_metadata() {
    scan_.line();
    while (!scan_.at_end() && !trimmed(scan_.line()).empty()) {
    }
  }

  void finish() {
    const std::size_t end = source_.text().size();
    if (!have_points_) source_.fail(end, "no POINTS", "the nodes of the mesh");
    if (!have_cells_) source_.fail(end, "no cells", "the elements of the mesh");
    if (grid_.types.size() != cell_count()) {
      source_.fail(polygons_ ? end : types_offset_,
                   std::to_string(grid_.types.size()) + " cell types",
                   std::to_string(cell_count()) + ", one for each cell");
    }
    collector_.finish(source_, grid_);
  }

  enum class Place { file, points, cells };

  Source& source_;
  Scanner scan_;
  LegacyArrays arrays_;
  Grid grid_;
  ArrayCollector collector_;
  bool polygons_ = false;
  bool have_points_ = false;
  bool have_cells_ = false;
  std::size_t point_count_ = 0;
  std::size_t types_offset_ = 0;
  Place place_ = Place::file;
  std::size_t values_ = 0;
};

ParsedMesh read_legacy(Source& source) { return LegacyReader(source).read(); }

/// Encodes a name: white space would end it, and '%' starts a code.
std::string encoded(const std::string& name) {
  static constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= ' ' || c == '%' || c == '"' || byte == 0x7f) {
      text += '%';
      text += digits[byte >> 4];
      text += digits[byte & 15];
    } else {
      text += c;
    }
  }
  return text;
}

/// Writes the numbers of an array, as text or as big-endian bytes.
class ArrayWriter {
 public:
  ArrayWriter(TextWriter& out, bool binary) : out_(out), binary_(binary) {}

  template <class Number>
  void put(Number value, char separator) {
    if (binary_) {
      out_.raw(value, true);
    } else {
      out_ << value << separator;
    }
  }
  void end() {
    if (binary_) out_ << '\n';
  }

 private:
  TextWriter& out_;
  bool binary_;
};

void write_cells(TextWriter& out, ArrayWriter& array, const Grid& grid) {
  out << "CELLS " << grid.cell_count() << ' ' << grid.cell_count() + grid.connectivity.size()
      << '\n';
  for (std::size_t c = 0; c < grid.cell_count(); ++c) {
    const auto begin = static_cast<std::size_t>(grid.offsets[c]);
    const auto end = static_cast<std::size_t>(grid.offsets[c + 1]);
    array.put(static_cast<std::int32_t>(end - begin), ' ');
    for (std::size_t k = begin; k < end; ++k) {
      array.put(static_cast<std::int32_t>(grid.connectivity[k]), k + 1 == end ? '\n' : ' ');
    }
  }
  array.end();
  out << "CELL_TYPES " << grid.cell_count() << '\n';
  for (const auto type : grid.types) array.put(static_cast<std::int32_t>(type), '\n');
  array.end();
}

void write_names(TextWriter& out, ArrayWriter& array, const Grid& grid) {
  const std::size_t n = grid.marker_names.size() + grid.region_names.size();
  if (n == 0) return;
  out << "FIELD FieldData " << n << '\n';
  const auto write = [&](const char* prefix, const std::vector<NamedTag>& names) {
    for (const auto& [name, tag] : names) {
      out << prefix << encoded(name) << " 1 1 int\n";
      array.put(static_cast<std::int32_t>(tag), '\n');
      array.end();
    }
  };
  write("marker:", grid.marker_names);
  write("region:", grid.region_names);
}

void write_tags(TextWriter& out, ArrayWriter& array, const Grid& grid) {
  const bool markers = !grid.marker_names.empty();
  const bool regions = !grid.region_names.empty();
  if (!markers && !regions) return;
  out << "CELL_DATA " << grid.cell_count() << "\nFIELD FieldData " << int{markers} + int{regions}
      << '\n';
  const auto write = [&](const char* name, const std::vector<int>& tags) {
    out << name << " 1 " << tags.size() << " int\n";
    for (const int tag : tags) array.put(static_cast<std::int32_t>(tag), '\n');
    array.end();
  };
  if (markers) write("marker", grid.marker);
  if (regions) write("region", grid.region);
}

std::vector<std::string> write_legacy(std::ostream& stream, const Mesh& mesh,
                                      const FormatDetails* source, const WriteOptions& options) {
  std::vector<std::string> warnings;
  const Grid grid = to_grid(mesh, source, warnings);
  TextWriter out(stream);
  ArrayWriter array(out, options.binary);
  out << "# vtk DataFile Version 3.0\nmesh\n" << (options.binary ? "BINARY\n" : "ASCII\n");
  out << "DATASET UNSTRUCTURED_GRID\n";
  out << "POINTS " << grid.points.size() / 3 << " double\n";
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    array.put(grid.points[i], i % 3 == 2 ? '\n' : ' ');
  }
  array.end();
  write_cells(out, array, grid);
  // Not before POINTS, where VTK itself puts them, because Gmsh expects POINTS in that line.
  write_names(out, array, grid);
  write_tags(out, array, grid);
  return warnings;
}

}  // namespace

const MeshFormat legacy_format{
    .name = "vtk",
    .title = "VTK",
    .versions = "legacy, versions 1 to 5 (written as 3.0)",
    .encodings = "text, binary",
    .markers = "yes, see below",
    .has_binary = true,
    .recognise =
        [](const Content& content) {
          return signature_if(content.first_line.starts_with("# vtk DataFile"));
        },
    .read = read_legacy,
    .write = write_legacy};

}  // namespace winslow::io::vtk
