#include <bit>

#include "io/text/text_writer.h"
#include "io/vtk/grid.h"
#include "io/vtk/vtu.h"

namespace winslow::io::vtk {
namespace {

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

/// Writes the XML with its arrays: as text at once, or as bytes that are appended at the end.
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

}  // namespace

std::vector<std::string> write_vtu(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                                   bool binary) {
  std::vector<std::string> warnings;
  const Grid grid = to_grid(mesh, source, warnings);
  Writer(out, grid, binary).write();
  return warnings;
}

}  // namespace winslow::io::vtk
