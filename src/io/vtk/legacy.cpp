#include <cstring>

#include "io/text/numbers.h"
#include "io/text/source.h"
#include "io/vtk/grid.h"

namespace winslow::io::vtk {

namespace {

using Kind = ValueKind;

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

/// Reads the arrays of a legacy file: numbers separated by white space, or big-endian bytes.
class LegacyArrays {
 public:
  explicit LegacyArrays(Scanner& scan) : scan_(scan) {}

  bool binary() const { return binary_; }
  void set_binary(bool binary) { binary_ = binary; }
  /// Next word of this line as a type. Throws InputError.
  ValueType type() {
    const auto word = scan_.word();
    const auto found = legacy_type(word);
    if (!found) scan_.fail(word, "a type such as float, double or int");
    return *found;
  }

  /// Checks a count read by the caller against the bytes left.
  Index count(const Expected& expected, const ValueType& type, std::size_t numbers_each) {
    return scan_.count(
        expected, std::max<std::size_t>(1, binary_ ? numbers_each * type.bytes : numbers_each * 2));
  }

  /// Reads numbers; `places`, if given, receives the byte offset of each.
  std::vector<double> numbers(std::size_t n, ValueType type, const Expected& expected,
                              std::vector<std::size_t>* places = nullptr) {
    if (type.kind == Kind::text || type.kind == Kind::bit) {
      scan_.source().fail(scan_.offset(), "an array that is not of numbers", expected.text());
    }
    begin_values(n, type, expected);
    return read<double>(n, type, expected, places);
  }
  /// Reads the n values of an array to be written again.
  void values(std::size_t n, const Expected& expected, DataArray& array) {
    const ValueType& type = array.type;
    if (type.kind == Kind::text) return strings(n, expected, array.bytes);
    begin_values(n, type, expected);
    array.bits = type.kind == Kind::bit ? n : 0;
    if (binary_) {
      const std::size_t size = size_of(n, type);
      array.bytes = scan_.source().text().substr(scan_.offset(), size);
      scan_.seek(scan_.offset() + size);
      swap_bytes(array.bytes, type.bytes);
      return;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto word = scan_.next_word();
      if (!append_value(array.bytes, type, word)) scan_.fail(word, expected);
    }
    if (type.kind == Kind::bit) array.bytes = packed_bits(array.bytes);
  }
  std::vector<std::int64_t> integers(std::size_t n, ValueType type, const Expected& expected,
                                     std::vector<std::size_t>* places = nullptr) {
    if (type.kind != Kind::signed_integer && type.kind != Kind::unsigned_integer) {
      scan_.source().fail(scan_.offset(), "an array that is not of integers", expected.text());
    }
    if (binary_) begin_bytes(n, type, expected);
    return read<std::int64_t>(n, type, expected, places);
  }

 private:
  static std::size_t size_of(std::size_t n, const ValueType& type) {
    return type.kind == Kind::bit ? n / 8 + (n % 8 != 0) : n * type.bytes;
  }
  /// Throws InputError unless n values can be left in the file.
  void begin_values(std::size_t n, const ValueType& type, const Expected& expected) {
    if (binary_) return begin_bytes(n, type, expected);
    if (n / 2 > scan_.bytes_left() + 1)
      scan_.source().fail(scan_.offset(), "too few numbers", expected.text());
  }
  void begin_bytes(std::size_t n, const ValueType& type, const Expected& expected) {
    const bool too_many = type.kind != Kind::bit && n > scan_.bytes_left();
    if (too_many || size_of(n, type) > scan_.bytes_left()) {
      scan_.source().fail(scan_.source().text().size(), "the end of the file", expected.text());
    }
  }

  /// Reads n strings, each to be ended by a zero. In binary, the two top bits of the first byte
  /// give the number of bytes of the length.
  void strings(std::size_t n, const Expected& expected, std::string& bytes) {
    const auto text = scan_.source().text();
    for (std::size_t i = 0; i < n; ++i) {
      if (scan_.at_end()) scan_.source().fail(text.size(), "the end of the file", expected.text());
      if (!binary_) {
        bytes += decoded(scan_.line()) + '\0';
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
      const std::size_t begin = scan_.offset() + width;
      bytes.append(text.substr(begin, static_cast<std::size_t>(length)));
      bytes += '\0';
      scan_.seek(begin + static_cast<std::size_t>(length));
    }
  }

  template <class Number>
  std::vector<Number> read(std::size_t n, ValueType type, const Expected& expected,
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

constexpr ValueType int32{Kind::signed_integer, 4};

class LegacyReader {
 public:
  explicit LegacyReader(Source& source) : source_(source), scan_(source), arrays_(scan_) {}

  ParsedMesh read(std::string_view regions) {
    read_header();
    for (auto word = scan_.next_word(); !word.empty(); word = scan_.next_word()) {
      read_section(word);
    }
    finish();
    find_groups(source_, grid_, regions);
    ParsedMesh mesh = to_mesh(source_, std::move(grid_));
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
    if (word == "METADATA") return read_metadata();
    if (place_ == Place::file && word != "FIELD") last_list_ = nullptr;
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
    const Index n = arrays_.count({"the number of points"}, {Kind::floating, 4}, 3);
    const ValueType type = arrays_.type();
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
    if (type == 0) return;
    const auto nodes = [&](std::size_t c) {
      return static_cast<std::size_t>(grid_.offsets[c + 1] - grid_.offsets[c]);
    };
    bool many = false;
    for (std::size_t c = before; c < cell_count(); ++c) many |= type == polygon && nodes(c) > 4;
    for (std::size_t c = before; c < cell_count(); ++c) {
      const std::int64_t own = type_of_polygon(type, nodes(c));
      // Beside polygons, one of four nodes may be a triangle with a hanging node.
      grid_.types.push_back(many && own == quadrilateral ? static_cast<std::int64_t>(polygon)
                                                         : own);
    }
  }

  /// The type of a cell of polygon data with that many nodes.
  static std::int64_t type_of_polygon(std::int64_t type, std::size_t nodes) {
    if (type == vertex) return nodes == 1 ? vertex : poly_vertex;
    if (type == poly_line) return nodes == 2 ? line : poly_line;
    return nodes == 3 ? triangle : nodes == 4 ? quadrilateral : polygon;
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
    const ValueType offset_type = arrays_.type();
    scan_.end_line({"the end of the line"});
    std::vector<std::size_t> places;
    const auto offsets = arrays_.integers(n, offset_type, {"an offset of a cell"}, &places);
    const auto word = scan_.next_word();
    if (word != "CONNECTIVITY") scan_.fail(word, "CONNECTIVITY");
    const ValueType type = arrays_.type();
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
    last_list_ = nullptr;
    place_ = of_cells ? Place::cells : Place::points;
    values_ = static_cast<std::size_t>(n);
    if (values_ != expected) {
      source_.fail(start, "data for " + std::to_string(n) + (of_cells ? " cells" : " points"),
                   std::to_string(expected));
    }
  }

  std::vector<DataArray>& list() {
    return place_ == Place::cells    ? grid_.data.cells
           : place_ == Place::points ? grid_.data.points
                                     : grid_.data.field;
  }

  void read_values(std::size_t n, DataArray array) {
    const bool colours = array.keyword == "LOOKUP_TABLE";
    arrays_.values(n, {colours ? "a colour of a lookup table" : "a value of a data array"}, array);
    last_list_ = &list();
    last_list_->push_back(std::move(array));
  }

  void read_lookup_table() {
    DataArray array{std::string(scan_.word()), colour_type(), 4};
    array.keyword = "LOOKUP_TABLE";
    const Index n = scan_.count({"the size of a lookup table"}, arrays_.binary() ? 4 : 8);
    scan_.end_line({"the end of the line"});
    read_values(4 * static_cast<std::size_t>(n), std::move(array));
  }

  /// Colours are bytes in binary files, and numbers from 0 to 1 in text.
  ValueType colour_type() const {
    return arrays_.binary() ? ValueType{Kind::unsigned_integer, 1} : ValueType{Kind::floating, 4};
  }

  void read_type(DataArray& array) {
    const std::size_t here = scan_.offset();
    array.type_word = scan_.word();
    scan_.seek(here);
    array.type = arrays_.type();
  }

  void read_attribute(std::string_view word) {
    if (word == "LOOKUP_TABLE") return read_lookup_table();
    DataArray array{decoded(scan_.word()), {}};
    const std::string& keyword = array.keyword = word;
    if (keyword == "COLOR_SCALARS") {
      array.components = static_cast<std::size_t>(scan_.count({"the number of components"}, 1));
      array.type = colour_type();
    } else if (keyword == "TEXTURE_COORDINATES") {
      array.components = static_cast<std::size_t>(scan_.count({"the number of components"}, 1));
      read_type(array);
    } else if (keyword == "SCALARS") {
      read_type(array);
      const auto given = scan_.word();
      const auto number = given.empty() ? 1 : parse_integer(given).value_or(0);
      if (number < 1 || number > 4) scan_.fail(given, "1 to 4 components");
      array.components = static_cast<std::size_t>(number);
      array.lookup_table = lookup_table_name();
    } else if (keyword == "VECTORS" || keyword == "NORMALS" || keyword == "TENSORS" ||
               keyword == "TENSORS6" || keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS" ||
               keyword == "EDGE_FLAGS") {
      read_type(array);
      array.components = keyword == "TENSORS" ? 9 : keyword == "TENSORS6" ? 6 : 3;
      if (keyword.ends_with("IDS") || keyword == "EDGE_FLAGS") array.components = 1;
    } else {
      scan_.fail(word, "the keyword of a data array, such as SCALARS or FIELD");
    }
    scan_.end_line({"the end of the line"});
    const std::size_t n = values_ * array.components;
    read_values(n, std::move(array));
  }

  /// In most files a separate line between SCALARS and its values names a lookup table; empty:
  /// there is none.
  std::string lookup_table_name() {
    const std::size_t here = scan_.offset();
    if (scan_.next_word() == "LOOKUP_TABLE") return std::string(scan_.word());
    scan_.seek(here);
    return {};
  }

  void read_field() {
    const std::string field(scan_.word());
    const Index n = scan_.count({"the number of arrays of a field"}, 4);
    scan_.end_line({"the end of the line"});
    for (Index a = 0; a < n; ++a) {
      const auto word = scan_.next_word();
      if (word == "METADATA") {
        read_metadata();
        --a;
        continue;
      }
      if (word.empty()) scan_.fail(word, Expected{"array of a field", a, n});
      DataArray array{decoded(word), {}};
      array.field = field;
      array.components = static_cast<std::size_t>(scan_.index({"the number of components"}));
      const std::size_t here = scan_.offset();
      const auto tuples = static_cast<std::size_t>(scan_.index({"the number of tuples"}));
      if (place_ != Place::file && tuples != values_)
        source_.fail(here,
                     std::to_string(tuples) + " values in " +
                         (place_ == Place::cells ? "cell" : "point") + " array \"" + array.name +
                         "\"",
                     std::to_string(values_));
      read_type(array);
      scan_.end_line({"the end of the line"});
      const std::size_t values = array.components * tuples;
      read_values(values, std::move(array));
    }
  }

  /// Metadata end at the next empty line, also in binary files. They belong to the array before.
  void read_metadata() {
    std::string lines = std::string(scan_.line());
    while (!scan_.at_end()) {
      const auto line = scan_.line();
      if (trimmed(line).empty()) break;
      lines.append(1, '\n').append(line);
    }
    if (last_list_ != nullptr && !last_list_->empty())
      last_list_->back().metadata = "METADATA" + lines + "\n\n";
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
    split_face_streams(source_, grid_);
  }

  enum class Place { file, points, cells };

  Source& source_;
  Scanner scan_;
  LegacyArrays arrays_;
  Grid grid_;
  std::vector<DataArray>* last_list_ = nullptr;  // the one that metadata belong to; null: none
  bool polygons_ = false;
  bool have_points_ = false;
  bool have_cells_ = false;
  std::size_t point_count_ = 0;
  std::size_t types_offset_ = 0;
  Place place_ = Place::file;
  std::size_t values_ = 0;
};

ParsedMesh read_legacy(Source& source, std::string_view regions) {
  return LegacyReader(source).read(regions);
}

}  // namespace

const MeshFormat legacy_format{
    .name = "vtk",
    .title = "VTK",
    .versions = "legacy, versions 1 to 5 (written as 3.0)",
    .encodings = "text, binary",
    .markers = "yes, see below",
    .polyhedra = true,
    .polygons = true,
    .keeps_data = true,
    .has_binary = true,
    .recognise =
        [](const Content& content) {
          return signature_if(content.first_line.starts_with("# vtk DataFile"));
        },
    .read_arrays = read_legacy,
    .write = write_legacy};

}  // namespace winslow::io::vtk
