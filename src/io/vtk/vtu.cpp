#include <pugixml.hpp>

#include "io/format/foreign_formats.h"
#include "io/text/numbers.h"
#include "io/text/source.h"
#include "io/vtk/face_stream.h"
#include "io/vtk/grid.h"
#include "io/vtk/vtu_arrays.h"

namespace winslow::io::vtk {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Location of the appended data. Raw data is no XML, so the file is split before parsing.
struct Appended {
  std::size_t xml_end;  ///< start of <AppendedData, or the end of the file
  std::size_t begin = 0;
  std::size_t end = 0;
  bool base64 = false;
};

Appended find_appended(const Source& source) {
  const auto text = source.text();
  const auto tag = text.find("<AppendedData");
  if (tag == std::string_view::npos) return {text.size()};
  const auto close = text.find('>', tag);
  const auto mark = close == std::string_view::npos ? close : text.find('_', close);
  if (mark == std::string_view::npos) {
    source.fail(tag, "<AppendedData> without '_'", "an underscore before the data");
  }
  const auto head = text.substr(tag, close - tag);
  const bool raw = head.find("raw") != std::string_view::npos;
  const bool base64 = head.find("base64") != std::string_view::npos;
  if (raw == base64) source.fail(tag, in_quotes(head), "encoding=\"raw\" or \"base64\"");
  auto end = text.rfind("</AppendedData");
  if (end == std::string_view::npos || end <= mark) end = text.size();
  return {tag, mark + 1, end, base64};
}

class VtuReader {
 public:
  explicit VtuReader(Source& source) : source_(source), appended_(find_appended(source)) {
    if (appended_.begin != 0 && !appended_.base64) source.set_binary_from(appended_.begin);
  }

  ParsedMesh read(std::string_view regions) {
    parse();
    const auto file = document_.child("VTKFile");
    if (!file) source_.fail(0, "no <VTKFile>", "a VTK XML file");
    const std::string_view kind = file.attribute("type").value();
    const VtuArrays arrays(source_, file, xml_begin_, appended_.begin, appended_.end,
                           appended_.base64);
    if (kind != "UnstructuredGrid") {
      source_.fail(arrays.place(file), "VTKFile type " + in_quotes(kind), "UnstructuredGrid");
    }
    const auto grid = file.child("UnstructuredGrid");
    const auto piece = grid.child("Piece");
    if (!piece) source_.fail(arrays.place(file), "no <Piece>", "one piece");
    if (const auto second = piece.next_sibling("Piece")) {
      source_.fail(arrays.place(second), "a second <Piece>",
                   "a mesh in one piece; ParaView joins them: " +
                       paraview_command(source_.name(), "MergeBlocks(OpenDataFile('IN'))"));
    }
    read_points(arrays, piece);
    read_cells(arrays, piece);
    read_data(arrays, grid, piece);
    find_groups(source_, grid_, regions);
    ParsedMesh mesh = to_mesh(source_, std::move(grid_));
    mesh.details->binary = binary_;
    return mesh;
  }

 private:
  void parse() {
    const auto text = source_.text();
    xml_begin_ = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    std::string xml(text.substr(xml_begin_, appended_.xml_end - xml_begin_));
    if (appended_.begin != 0) xml += "</VTKFile>";
    const auto result =
        document_.load_buffer(xml.data(), xml.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
      source_.fail(xml_begin_ + static_cast<std::size_t>(result.offset),
                   std::string("malformed XML (") + result.description() + ")", "a VTU file");
    }
  }

  pugi::xml_node child(const VtuArrays& arrays, const pugi::xml_node& parent,
                       const char* name) const {
    const auto node = parent.child(name);
    if (!node) {
      source_.fail(arrays.place(parent), "no <" + std::string(name) + ">", "one in the piece");
    }
    return node;
  }

  pugi::xml_node array(const VtuArrays& arrays, const pugi::xml_node& parent,
                       const char* name) const {
    const auto node = parent.find_child_by_attribute("DataArray", "Name", name);
    if (!node) {
      source_.fail(arrays.place(parent), "no array \"" + std::string(name) + "\"", "one here");
    }
    return node;
  }

  /// Compares an attribute such as NumberOfPoints with the size of the arrays.
  void check_count(const VtuArrays& arrays, const pugi::xml_node& piece, const char* name,
                   std::size_t found) const {
    const std::string_view text = piece.attribute(name).value();
    if (parse_integer(text) == static_cast<std::int64_t>(found)) return;
    source_.fail(arrays.place(piece), std::string(name) + "=" + in_quotes(text),
                 std::to_string(found) + ", which the arrays hold");
  }

  void note_encoding(const pugi::xml_node& data) {
    binary_ = binary_ || std::string_view(data.attribute("format").as_string("ascii")) != "ascii";
  }

  void read_points(const VtuArrays& arrays, const pugi::xml_node& piece) {
    const auto points = child(arrays, piece, "Points");
    const auto data = points.child("DataArray");
    if (!data) source_.fail(arrays.place(points), "no array", "the coordinates of the points");
    if (data.attribute("NumberOfComponents").as_int() != 3) {
      source_.fail(
          arrays.place(data),
          "points of " + in_quotes(data.attribute("NumberOfComponents").value()) + " components",
          "3");
    }
    note_encoding(data);
    grid_.points_name = data.attribute("Name").as_string("Points");
    std::vector<std::size_t> places;
    grid_.points = arrays.numbers(data, &places);
    if (grid_.points.size() % 3 != 0) {
      source_.fail(arrays.place(data), std::to_string(grid_.points.size()) + " coordinates",
                   "three for each point");
    }
    check_count(arrays, piece, "NumberOfPoints", grid_.points.size() / 3);
    for (std::size_t i = 0; i < places.size(); i += 3) grid_.point_places.push_back(places[i]);
  }

  void read_cells(const VtuArrays& arrays, const pugi::xml_node& piece) {
    const auto cells = child(arrays, piece, "Cells");
    std::vector<std::size_t> node_places;
    std::vector<std::size_t> offset_places;
    const auto connectivity = array(arrays, cells, "connectivity");
    const auto offsets = array(arrays, cells, "offsets");
    const auto types = array(arrays, cells, "types");
    grid_.connectivity = arrays.integers(connectivity, &node_places);
    const auto ends = arrays.integers(offsets, &offset_places);
    grid_.list_types = {arrays.value_type(connectivity), arrays.value_type(offsets),
                        arrays.value_type(types)};
    check_count(arrays, piece, "NumberOfCells", ends.size());
    grid_.types = arrays.integers(types, nullptr, ends.size());
    if (grid_.types.size() != ends.size()) {
      source_.fail(arrays.place(types), std::to_string(grid_.types.size()) + " cell types",
                   std::to_string(ends.size()) + ", one for each cell");
    }
    const auto size = static_cast<std::int64_t>(grid_.connectivity.size());
    for (std::size_t c = 0; c < ends.size(); ++c) {
      const auto begin = grid_.offsets.back();
      if (ends[c] < begin || ends[c] > size) {
        source_.fail(offset_places[c], std::to_string(ends[c]) + " as the offset of a cell",
                     std::to_string(begin) + " to " + std::to_string(size));
      }
      grid_.offsets.push_back(ends[c]);
      const auto first = static_cast<std::size_t>(begin);
      grid_.cell_places.push_back(first < node_places.size() ? node_places[first]
                                                             : offset_places[c]);
    }
    if (grid_.offsets.back() != size) {
      source_.fail(arrays.place(cells), std::to_string(size) + " numbers in the connectivity",
                   std::to_string(grid_.offsets.back()) + ", the last offset");
    }
    read_faces(source_, arrays, cells, grid_);
  }

  /// Reads the arrays below an element. tuples: as in VtuArrays::data_array().
  static void read_arrays(const VtuArrays& arrays, const pugi::xml_node& parent,
                          VtuArrays::Count tuples, std::vector<DataArray>& list) {
    for (const auto& array : parent.children()) {
      const std::string_view kind = array.name();
      if (kind == "DataArray" || kind == "Array") list.push_back(arrays.data_array(array, tuples));
    }
  }

  static Attributes attributes_of(const pugi::xml_node& element) {
    Attributes attributes;
    for (const auto& attribute : element.attributes())
      attributes.emplace_back(attribute.name(), attribute.value());
    return attributes;
  }

  void read_data(const VtuArrays& arrays, const pugi::xml_node& grid, const pugi::xml_node& piece) {
    for (const auto& parent : {grid.child("FieldData"), piece.child("FieldData")})
      read_arrays(arrays, parent, {}, grid_.data.field);
    const auto points = piece.child("PointData"), cells = piece.child("CellData");
    read_arrays(arrays, points, grid_.points.size() / 3, grid_.data.points);
    read_arrays(arrays, cells, grid_.types.size(), grid_.data.cells);
    grid_.data.point_attributes = attributes_of(points);
    grid_.data.cell_attributes = attributes_of(cells);
  }

  Source& source_;
  Appended appended_;
  pugi::xml_document document_;
  std::size_t xml_begin_ = 0;
  Grid grid_;
  bool binary_ = false;
};

ParsedMesh read_vtu(Source& source, std::string_view regions) {
  return VtuReader(source).read(regions);
}

static_assert(std::endian::native == std::endian::little,
              "appended data is declared little-endian and written as it lies in memory");

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\t':
        safe += "&#9;";
        break;
      case '\n':
        safe += "&#10;";
        break;
      case '\r':
        safe += "&#13;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < ' ' ? '_' : c;
    }
  }
  return safe;
}

/// The values as an array of a type.
template <class Number>
DataArray array_of(std::string name, const ValueType& type, std::span<const Number> values) {
  DataArray array{std::move(name), type};
  array.bytes.reserve(values.size() * type.bytes);
  for (const Number value : values) {
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    array.bytes.append(raw.data(), type.bytes);  // the low bytes of an integer come first
  }
  return array;
}

/// Writes the XML with its arrays: inline as text, or as bytes appended at the end.
class Writer {
 public:
  Writer(std::ostream& stream, const Grid& grid, bool binary)
      : out_(stream), grid_(grid), binary_(binary) {}

  void write() {
    // Only files of version 2.3 have the faces of polyhedra in four arrays.
    out_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\""
         << (grid_.face_tables.empty() ? "1.0" : "2.3")
         << "\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n";
    if (!grid_.data.field.empty()) write_list("FieldData", {}, grid_.data.field);
    out_ << "<Piece NumberOfPoints=\"" << grid_.points.size() / 3 << "\" NumberOfCells=\""
         << grid_.cell_count() << "\">\n<Points>\n";
    write_points();
    out_ << "</Points>\n<Cells>\n";
    using Integers = std::span<const std::int64_t>;
    const CellListTypes& types = grid_.list_types;
    write_array(array_of("connectivity", types.connectivity, Integers(grid_.connectivity)), 12);
    write_array(array_of("offsets", types.offsets, Integers(grid_.offsets).subspan(1)), 12);
    write_array(array_of("types", types.types, Integers(grid_.types)), 24);
    if (!grid_.face_tables.empty())
      for (const DataArray& table : grid_.face_tables) write_array(table, 12);
    else if (!grid_.face_offsets.empty())
      write_faces();
    out_ << "</Cells>\n";
    if (!grid_.data.points.empty())
      write_list("PointData", grid_.data.point_attributes, grid_.data.points);
    write_list("CellData", grid_.data.cell_attributes, grid_.data.cells);
    out_ << "</Piece>\n</UnstructuredGrid>\n";
    if (binary_) {
      out_ << "<AppendedData encoding=\"raw\">\n_" << appended_ << "\n</AppendedData>\n";
    }
    out_ << "</VTKFile>\n";
  }

 private:
  void write_points() {
    DataArray array = array_of(grid_.points_name, {ValueKind::floating, 8},
                               std::span<const double>(grid_.points));
    array.components = 3;
    write_array(array, 3);
  }

  void write_faces() {
    std::vector<std::int64_t> ends;
    for (std::size_t c = 0; c < grid_.cell_count(); ++c)
      ends.push_back(grid_.types[c] == polyhedron ? grid_.face_offsets[c + 1] : -1);
    using Integers = std::span<const std::int64_t>;
    write_array(array_of("faces", grid_.list_types.faces, Integers(grid_.faces)), 12);
    write_array(array_of("faceoffsets", grid_.list_types.face_offsets, Integers(ends)), 12);
  }

  void write_list(const char* element, const Attributes& attributes,
                  const std::vector<DataArray>& arrays) {
    out_ << '<' << element;
    write_attributes(attributes);
    out_ << ">\n";
    for (const DataArray& array : arrays)
      write_array(array, array.components > 1 ? array.components : 24);
    out_ << "</" << element << ">\n";
  }

  void write_attributes(const Attributes& attributes) {
    for (const auto& [name, value] : attributes)
      out_ << ' ' << name << "=\"" << escaped(value) << '"';
  }

  void write_array(const DataArray& array, std::size_t per_line) {
    const char* element = array.plain_element ? "Array" : "DataArray";
    out_ << '<' << element << " type=\"" << xml_name(array.type) << "\" Name=\""
         << escaped(array.name) << '"';
    const bool counts = std::ranges::any_of(
        array.attributes, [](const auto& pair) { return pair.first == "NumberOfComponents"; });
    if (array.components != 1 && !counts)
      out_ << " NumberOfComponents=\"" << array.components << '"';
    write_attributes(array.attributes);
    if (binary_) {
      append_data(array, element);
    } else {
      write_text(array, per_line);
      out_ << array.children << "</" << element << ">\n";
    }
  }

  void append_data(const DataArray& array, const char* element) {
    out_ << " format=\"appended\" offset=\"" << appended_.size() << '"';
    if (array.children.empty())
      out_ << "/>\n";
    else
      out_ << ">\n" << array.children << "</" << element << ">\n";
    const std::uint64_t size = array.bytes.size();
    appended_.append(reinterpret_cast<const char*>(&size), sizeof size);
    appended_.append(array.bytes);
  }

  void write_text(const DataArray& array, std::size_t per_line) {
    out_ << " format=\"ascii\">\n";
    write_lines(out_, array, per_line);
  }

  TextWriter out_;
  const Grid& grid_;
  bool binary_;
  std::string appended_;
};

/// XML files have no lookup tables, which legacy files hold among their arrays.
void drop_lookup_tables(DataArrays& data, std::vector<std::string>& warnings) {
  for (auto* list : {&data.points, &data.cells}) {
    std::erase_if(*list, [&](const DataArray& array) {
      if (array.keyword != "LOOKUP_TABLE") return false;
      warnings.push_back("the lookup table \"" + array.name + "\" is not written");
      return true;
    });
  }
}

std::vector<std::string> write_vtu(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                                   const WriteOptions& options) {
  std::vector<std::string> warnings;
  Grid grid = to_grid(mesh, source, warnings);
  drop_lookup_tables(grid.data, warnings);
  Writer(out, grid, options.binary).write();
  return warnings;
}

}  // namespace

const MeshFormat vtu_format{
    .name = "vtu",
    .title = "VTK XML",
    .encodings =
        "text, inline base64, appended raw and base64, zlib, LZ4 (written as text or appended raw)",
    .markers = "yes, see below",
    .polyhedra = true,
    .polygons = true,
    .keeps_data = true,
    .has_binary = true,
    .recognise =
        [](const Content& content) {
          return signature_if(content.start.starts_with("<") &&
                              content.start.substr(0, 2000).find("<VTKFile") !=
                                  std::string_view::npos);
        },
    .read_arrays = read_vtu,
    .write = write_vtu};

}  // namespace winslow::io::vtk
