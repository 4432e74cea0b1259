#include <pugixml.hpp>

#include "io/format/foreign_formats.h"
#include "io/text/numbers.h"
#include "io/text/source.h"
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

  ParsedMesh read() {
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
    collector_.finish(source_, grid_);
    ParsedMesh mesh = to_mesh(source_, grid_);
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
    grid_.connectivity = arrays.integers(array(arrays, cells, "connectivity"), &node_places);
    const auto ends = arrays.integers(array(arrays, cells, "offsets"), &offset_places);
    const auto types = array(arrays, cells, "types");
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
  }

  /// The values of an array with one number per cell. Other arrays are not written by winslow and
  /// are not read.
  std::vector<double> cell_numbers(const VtuArrays& arrays, const pugi::xml_node& data,
                                   unsigned components) const {
    if (components != 1) return {};
    return arrays.numbers(data, nullptr, grid_.types.size());
  }

  void read_data(const VtuArrays& arrays, const pugi::xml_node& grid, const pugi::xml_node& piece) {
    for (const auto& data : piece.child("CellData").children("DataArray")) {
      const auto components = data.attribute("NumberOfComponents").as_uint(1);
      collector_.cell_array(data.attribute("Name").value(), cell_numbers(arrays, data, components),
                            components);
    }
    for (const auto& parent : {grid.child("FieldData"), piece.child("FieldData")}) {
      for (const auto& data : parent.children("DataArray")) {
        // winslow writes no arrays of strings.
        const bool number = std::string_view(data.attribute("type").value()) != "String";
        collector_.field_array(data.attribute("Name").value(),
                               number ? arrays.numbers(data) : std::vector<double>());
      }
      drop(parent, "Array");
    }
    drop(piece.child("PointData"), "DataArray");
    drop(piece.child("PointData"), "Array");
    drop(piece.child("CellData"), "Array");
  }

  /// Records the arrays below an element that are not read.
  void drop(const pugi::xml_node& parent, const char* kind) {
    for (const auto& array : parent.children(kind))
      grid_.dropped.emplace(array.attribute("Name").value());
  }

  Source& source_;
  Appended appended_;
  pugi::xml_document document_;
  std::size_t xml_begin_ = 0;
  Grid grid_;
  ArrayCollector collector_;
  bool binary_ = false;
};

ParsedMesh read_vtu(Source& source) { return VtuReader(source).read(); }

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
      default:
        safe += static_cast<unsigned char>(c) < ' ' ? '_' : c;
    }
  }
  return safe;
}

template <class Number>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<Number, double>) return "Float64";
  if constexpr (std::is_same_v<Number, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<Number, std::uint8_t>) return "UInt8";
  return "Int32";
}

/// Writes the XML with its arrays: inline as text, or as bytes appended at the end.
class Writer {
 public:
  Writer(std::ostream& stream, const Grid& grid, bool binary)
      : out_(stream), grid_(grid), binary_(binary) {}

  void write() {
    out_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n";
    write_names();
    out_ << "<Piece NumberOfPoints=\"" << grid_.points.size() / 3 << "\" NumberOfCells=\""
         << grid_.cell_count() << "\">\n<Points>\n";
    write_array("Points", grid_.points, " NumberOfComponents=\"3\"", 3);
    out_ << "</Points>\n<Cells>\n";
    write_array("connectivity", grid_.connectivity, "", 12);
    write_array("offsets",
                std::vector<std::int64_t>(grid_.offsets.begin() + 1, grid_.offsets.end()), "", 12);
    write_array("types", std::vector<std::uint8_t>(grid_.types.begin(), grid_.types.end()), "", 24);
    out_ << "</Cells>\n<CellData>\n";
    if (!grid_.marker_names.empty()) write_array("marker", grid_.marker, "", 24);
    if (!grid_.region_names.empty()) write_array("region", grid_.region, "", 24);
    out_ << "</CellData>\n</Piece>\n</UnstructuredGrid>\n";
    if (binary_) {
      out_ << "<AppendedData encoding=\"raw\">\n_" << appended_ << "\n</AppendedData>\n";
    }
    out_ << "</VTKFile>\n";
  }

 private:
  void write_names() {
    if (grid_.marker_names.empty() && grid_.region_names.empty()) return;
    out_ << "<FieldData>\n";
    for (const auto& [name, tag] : grid_.marker_names) write_name("marker:" + name, tag);
    for (const auto& [name, tag] : grid_.region_names) write_name("region:" + name, tag);
    out_ << "</FieldData>\n";
  }
  void write_name(const std::string& name, int tag) {
    write_array(name, std::vector<int>{tag}, " NumberOfTuples=\"1\"", 1);
  }

  template <class Number>
  void write_array(const std::string& name, const std::vector<Number>& values,
                   const char* attributes, std::size_t per_line) {
    out_ << "<DataArray type=\"" << type_name<Number>() << "\" Name=\"" << escaped(name) << '"'
         << attributes;
    if (binary_) {
      out_ << " format=\"appended\" offset=\"" << appended_.size() << "\"/>\n";
      const std::uint64_t size = values.size() * sizeof(Number);
      appended_.append(reinterpret_cast<const char*>(&size), sizeof size);
      appended_.append(reinterpret_cast<const char*>(values.data()), size);
      return;
    }
    out_ << " format=\"ascii\">\n";
    for (std::size_t i = 0; i < values.size(); ++i) {
      out_ << values[i] << ((i + 1) % per_line == 0 || i + 1 == values.size() ? '\n' : ' ');
    }
    out_ << "</DataArray>\n";
  }

  TextWriter out_;
  const Grid& grid_;
  bool binary_;
  std::string appended_;
};

std::vector<std::string> write_vtu(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                                   const WriteOptions& options) {
  std::vector<std::string> warnings;
  const Grid grid = to_grid(mesh, source, warnings);
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
    .has_binary = true,
    .recognise =
        [](const Content& content) {
          return signature_if(content.start.starts_with("<") &&
                              content.start.substr(0, 2000).find("<VTKFile") !=
                                  std::string_view::npos);
        },
    .read = read_vtu,
    .write = write_vtu};

}  // namespace winslow::io::vtk
