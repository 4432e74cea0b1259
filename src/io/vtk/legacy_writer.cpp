#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "io/text/text_writer.h"
#include "io/vtk/grid.h"
#include "io/vtk/legacy.h"

namespace winslow::io::vtk {
namespace {

/// Names end at white space and hold '%' as the start of a code.
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

/// Numbers of an array, as text or as big-endian bytes.
class ArrayWriter {
 public:
  ArrayWriter(TextWriter& out, bool binary) : out_(out), binary_(binary) {}

  template <class Number>
  void put(Number value, char separator) {
    if (!binary_) {
      out_ << value << separator;
      return;
    }
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    if constexpr (std::endian::native == std::endian::little) {
      std::reverse(bytes.begin(), bytes.end());
    }
    out_.raw(bytes);
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

}  // namespace

std::vector<std::string> write_legacy(std::ostream& stream, const Mesh& mesh,
                                      const FormatDetails* source, bool binary) {
  std::vector<std::string> warnings;
  const Grid grid = to_grid(mesh, source, warnings);
  TextWriter out(stream);
  ArrayWriter array(out, binary);
  out << "# vtk DataFile Version 3.0\nmesh\n" << (binary ? "BINARY\n" : "ASCII\n");
  out << "DATASET UNSTRUCTURED_GRID\n";
  out << "POINTS " << grid.points.size() / 3 << " double\n";
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    array.put(grid.points[i], i % 3 == 2 ? '\n' : ' ');
  }
  array.end();
  write_cells(out, array, grid);
  // Not before POINTS, where VTK puts them itself: Gmsh looks for POINTS in that line.
  write_names(out, array, grid);
  write_tags(out, array, grid);
  return warnings;
}

}  // namespace winslow::io::vtk
